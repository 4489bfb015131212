// SPDX-License-Identifier: MIT
#include "scene/joints_text.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

// In the order of JointKind.
constexpr const char* kJointKinds[] = {"revolute", "distance", "prismatic", "weld",     "target",
                                       "wheel",    "groove",   "rotary",    "ratchet",  "gear",
                                       "rack",     "pulley",   "motor",     "friction", "filter"};
static_assert(std::size(kJointKinds) + 1 == std::variant_size_v<JointKind>);  // all but OwnJoint

template <std::size_t I>
void readKind(ObjectReader& in, JointText& joint, const Node& node)
{
    if (!joint.kind.empty()) {
        in.node().refuse("must have one kind: \"" + joint.kind + "\" or \"" + kJointKinds[I] + "\"");
    }
    std::variant_alternative_t<I, JointKind> kind;
    readValue(node, kind);
    joint.def.kind = kind;
    joint.kind = kJointKinds[I];
}

template <std::size_t... I>
void readKinds(ObjectReader& in, JointText& joint, std::index_sequence<I...>)
{
    const auto read = [&]<std::size_t K>() {
        if (const std::optional<Node> node = in.find(kJointKinds[K])) readKind<K>(in, joint, *node);
    };
    (read.template operator()<I>(), ...);
}

}  // namespace

JointText readJoint(ObjectReader& in)
{
    JointText joint;
    readKinds(in, joint, std::make_index_sequence<std::size(kJointKinds)>());
    in.readFields(joint.def);
    if (joint.kind.empty()) {
        std::string rule = "must have a kind: one of the keys";
        for (const char* kind : kJointKinds) rule += std::string(" \"") + kind + "\"";
        in.node().refuse(rule);
    }
    return joint;
}

OrderedJson jointJson(const JointDef& def, bool everything)
{
    OrderedJson out = OrderedJson::object();
    const auto write = [&](const auto& kind) {
        if constexpr (!std::is_same_v<decltype(kind), const OwnJoint&>)
            out[kJointKinds[def.kind.index()]] = fieldsJson(kind, everything);
    };
    std::visit(write, def.kind);
    out.update(fieldsJson(def, everything));
    return out;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
