// SPDX-License-Identifier: MIT
// The rules of what a joint may be [R4]: its bodies, the answers of a constraint of one's own, how it breaks.

#include "joints/own.hpp"
#include "world/check_alive.hpp"
#include "world/impl.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Asks a constraint where its bodies are: what it answers now it must not answer later.
Complaint checkAnswer(const OwnJoint& kind, const JointRow& joint, const BodyTable& bodies,
                      std::uint32_t& layout)
{
    const std::string name(kind.name());
    const OwnPose pose = ownPoseOf(joint, bodies);
    ConstraintRows answer(pose.count);
    std::string thrown;
    askConstraint(kind, pose, answer, &thrown);
    layout = layoutOf(answer);
    const ConstraintRows::Problem& wrong = answer.problem();
    if (!wrong.field) return std::nullopt;
    if (std::string_view(wrong.field) == "measure")
        return InputError(name + ".measure", textOf(thrown), wrong.rule);
    const std::string row = wrong.row < 0 ? "position" : "rows[" + textOf(wrong.row) + "]";
    return InputError(name + "." + row + "." + wrong.field, textOf(wrong.value), wrong.rule);
}

}  // namespace

Complaint World::Impl::check(const JointDef& def, std::uint32_t& layout) const
{
    if (Complaint wrong = checkBodies(def)) return wrong;
    Checks checks;
    checks.add(checkKind(def, def.kind, layout)).add(tamias2d::check(def.breaking));
    return checks.first();
}

Complaint World::Impl::checkBodies(const JointDef& def) const
{
    const auto complain = [&](std::string_view field, BodyId body, std::string_view rule) -> Complaint {
        return InputError(std::string(field), textOfId(body), std::string(rule));
    };
    if (!bodies.ids.owns(def.bodyA))
        return complain("JointDef.bodyA", def.bodyA, "must be a live body of this world");
    if (!bodies.ids.owns(def.bodyB))
        return complain("JointDef.bodyB", def.bodyB, "must be a live body of this world");
    const OwnJoint* const own = std::get_if<OwnJoint>(&def.kind);
    const bool isAlone = own && own->bodies() == 1;
    if ((def.bodyA == def.bodyB) != isAlone)
        return complain("JointDef.bodyB", def.bodyB,
                        isAlone ? "must be the same body as bodyA" : "must be another body than bodyA");
    bool isDynamic = row(def.bodyA).isDynamic() || row(def.bodyB).isDynamic();
    for (std::size_t i = 0; i < def.moreBodies.size(); ++i) {
        const BodyId body = def.moreBodies[i];
        if (!bodies.ids.owns(body))
            return complain("JointDef.moreBodies", body, "must be a live body of this world");
        bool isNew = body != def.bodyA && body != def.bodyB;
        for (std::size_t k = 0; k < i; ++k) isNew = isNew && def.moreBodies[k] != body;
        if (!isNew) return complain("JointDef.moreBodies", body, "must be another body than all others");
        isDynamic = isDynamic || row(body).isDynamic();
    }
    if (!isDynamic) return complain("JointDef.bodyB", def.bodyB, "must be dynamic, as bodyA is not");
    return std::nullopt;
}

Complaint World::Impl::checkKind(const JointDef& def, const JointKind& kind, std::uint32_t& layout) const
{
    layout = 0;
    if (Complaint wrong = tamias2d::check(kind, settings.lengthUnit)) return wrong;
    const OwnJoint* const own = std::get_if<OwnJoint>(&kind);
    const std::size_t count = (def.bodyA == def.bodyB ? 1 : 2) + def.moreBodies.size();
    const std::size_t wanted = own ? static_cast<std::size_t>(own->bodies()) : 2;
    if (count != wanted)
        return InputError("JointDef.moreBodies", textOf(def.moreBodies.size()),
                          "must make " + textOf(wanted) + " bodies in all, not " + textOf(count));
    if (!own) return std::nullopt;
    JointRow joint;
    joint.bodyA = def.bodyA.index;
    joint.bodyB = def.bodyB.index;
    for (const BodyId body : def.moreBodies) joint.more.push_back(body.index);
    beginOwnCount(joint, bodies);
    return checkAnswer(*own, joint, bodies, layout);
}

Complaint check(const JointBreaking& b)
{
    const auto isPositive = [](real value) { return value > 0 && value <= kUnlimited; };
    constexpr std::string_view rule = "must be > 0 and at most kUnlimited";
    return Checks()
        .that(isPositive(b.force), "JointBreaking.force", b.force, rule)
        .that(isPositive(b.torque), "JointBreaking.torque", b.torque, rule)
        .that(isPositive(b.error), "JointBreaking.error", b.error, rule)
        .range("JointBreaking.window", b.window, 0, static_cast<double>(kUnlimited),
               "must be in [0, kUnlimited] s")
        .first();
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
