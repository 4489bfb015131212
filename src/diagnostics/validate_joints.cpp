// SPDX-License-Identifier: MIT
// What must hold of joints.

#include "diagnostics/validate.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

void validateJointState(const JointRow& j, Faults& faults)
{
    faults.that(!j.broken || !j.def.enabled, "broken", j.broken, "must not be of a joint that is enabled");
    faults.range("stiffSteps", j.stiffSteps, -1000, 1000, "must be in [-1000, 1000]");
    faults.finite("angle", j.angle);
    faults.finite("angleA", j.angleA);
    faults.finite("notch", j.notch);
    for (const CountedAngle& angle : j.angles) faults.finite("angles", angle.now - angle.start);
    for (const real impulse : j.impulses) faults.finite("impulses", impulse);
    for (int i = JointSlot::kLower; i < JointSlot::kLower + JointSlot::kLimits; ++i)
        faults.that(j.impulses[i] >= 0, "impulses", j.impulses[i], "must not pull of a limit");
    faults.finite("stepImpulse", j.stepImpulse);
    faults.finite("stepTurn", j.stepTurn);
    faults.finite("stepWork", j.stepWork);
}

}  // namespace

void validateJoints(const JointTable& joints, const BodyTable& bodies, Faults& faults)
{
    validateIds(joints.ids, "joints", joints.rows.size(), faults);
    faults.that(joints.ofBody.size() <= bodies.rows.size(), "ofBody", joints.ofBody.size(),
                "must be one list a body at most");
    const auto timesListed = [&](std::uint32_t body, std::uint32_t joint) {
        if (body >= joints.ofBody.size()) return std::ptrdiff_t{0};
        return std::count(joints.ofBody[body].begin(), joints.ofBody[body].end(), joint);
    };
    std::size_t places = 0;
    for (std::uint32_t slot = 0; slot < joints.rows.size(); ++slot) {
        if (!joints.ids.isAlive(slot)) continue;
        const JointRow& j = joints.rows[slot];
        faults.at("joints", slot);
        const auto validateBody = [&](BodyId id, std::uint32_t body) {
            faults.that(bodies.ids.owns(id) && id.index == body, "body", body, "must be a live body");
            faults.that(timesListed(body, slot) == 1, "ofBody", body, "must list it once");
        };
        validateBody(j.def.bodyA, j.bodyA);
        validateBody(j.def.bodyB, j.bodyB);
        faults.that(j.more.size() == j.def.moreBodies.size(), "more", j.more.size(), "must be as many");
        for (std::size_t k = 0; k < minimum(j.more.size(), j.def.moreBodies.size()); ++k)
            validateBody(j.def.moreBodies[k], j.more[k]);
        const auto* const own = std::get_if<OwnJoint>(&j.def.kind);
        faults.that((j.bodyA == j.bodyB) == (own && own->bodies() == 1), "body", j.bodyB,
                    "must be another one");
        std::size_t count = 0;
        j.eachBody([&](std::uint32_t) { ++count; });
        faults.that(j.angles.size() == (own ? count : 0), "angles", j.angles.size(),
                    "must be one for each body of a joint of one's own");
        places += count;
        validateJointState(j, faults);
    }
    std::size_t listed = 0;
    for (const std::vector<std::uint32_t>& list : joints.ofBody) listed += list.size();
    faults.at("joints", 0);
    faults.that(listed == places, "ofBody", listed, "must be one for each body of each live joint");
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
