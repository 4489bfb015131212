// SPDX-License-Identifier: MIT
#include <tamias2d/scene/write.hpp>

#include "scene/geometry_text.hpp"
#include "scene/joints_text.hpp"
#include "scene/laws_text.hpp"
#include "scene/pretty.hpp"

#include <map>

namespace tamias2d::inline TAMIAS_PRECISION {

namespace {

using namespace scene;

OrderedJson shapeJson(const ShapeDef& def, bool everything)
{
    OrderedJson out;
    writeGeometry(out, def.geometry);
    out.update(fieldsJson(def, everything));
    out.update(fieldsJson(def.material, everything));
    return out;
}

OrderedJson bodyJson(const Body& body, bool everything)
{
    const BodyDef def = body.definition();
    OrderedJson out = fieldsJson(def, everything);
    const Locks locks{def.lockX, def.lockY, def.lockRotation};
    if (everything || locks.x || locks.y || locks.rotation) out["locks"] = fieldsJson(locks, everything);
    for (const LastingForce& force : body.lastingForces()) {
        out["forces"].push_back(fieldsJson(force, everything));
    }
    for (const Shape& shape : body.shapes()) {
        out["shapes"].push_back(shapeJson(shape.definition(), everything));
    }
    return out;
}

/// In the order of their addition, which is the order in which their forces are summed; so a law of
/// one body names its body here instead of standing inside it.
OrderedJson lawsJson(const World& world, const std::map<BodyId, std::size_t>& places)
{
    OrderedJson out = OrderedJson::array();
    for (const auto& [body, law] : world.forceLaws()) {
        OrderedJson written = lawJson(law);
        if (!body.isNull()) written["body"] = places.at(body);
        out.push_back(written);
    }
    return out;
}

}  // namespace

std::string writeScene(const World& world, const SceneInfo& info, const SceneWriteOptions& options)
{
    // Handles exist for worlds that may change only; nothing is changed through them here.
    World& handles = const_cast<World&>(world);

    OrderedJson out = {{"tamias2d", kSceneVersion}};
    if (options.everything || !info.title.empty()) out["title"] = info.title;
    if (options.everything || !info.description.empty()) out["description"] = info.description;
    const OrderedJson settings = fieldsJson(world.definition(), options.everything);
    if (!settings.empty()) out["world"] = settings;
    const OrderedJson run = fieldsJson(info, options.everything);
    if (!run.empty()) out["run"] = run;
    if (info.view) out["view"] = toJson(*info.view);

    std::map<BodyId, std::size_t> places;
    out["bodies"] = OrderedJson::array();
    for (const BodyId id : world.bodies()) {
        places.emplace(id, places.size());
        out["bodies"].push_back(bodyJson(handles.body(id), options.everything));
    }
    for (const JointId id : world.joints()) {
        const JointDef def = handles.joint(id).definition();
        if (const auto* own = std::get_if<OwnJoint>(&def.kind)) {
            const std::size_t place = out.contains("joints") ? out["joints"].size() : 0;
            fail(InputError("joints[" + std::to_string(place) + "]", std::string(own->name()),
                            "must be of a built-in kind: a file holds no code"));
            return {};
        }
        OrderedJson joint = {{"bodyA", places.at(def.bodyA)}, {"bodyB", places.at(def.bodyB)}};
        joint.update(jointJson(def, options.everything));
        out["joints"].push_back(joint);
    }
    const OrderedJson laws = lawsJson(world, places);
    if (!laws.empty()) out["laws"] = laws;
    return prettyText(out);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
