// SPDX-License-Identifier: MIT
#pragma once

#include "base/id_pool.hpp"

#include <tamias2d/model/joint_defs.hpp>

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Places of the rows of a joint among its impulses. Kinds use those they need.
struct JointSlot {
    static constexpr int kBlock = 0;   // 0 to 2: what is rigid, solved together
    static constexpr int kSpring = 3;  // 3 to 5: springs
    static constexpr int kMotor = 6;
    static constexpr int kLower = 7;
    static constexpr int kUpper = 8;
    static constexpr int kRope = 9;    // a third limit
    static constexpr int kCount = 10;
    static constexpr int kLimits = 3;  // from kLower on
};

/// Of a body, turns counted.   [rad]
struct CountedAngle {
    double now = 0;
    double start = 0;  // when the joint was made
};

/// Everything the world remembers of a joint between steps.
struct JointRow {
    JointDef def;                          // as given
    std::uint32_t bodyA = 0, bodyB = 0;    // slots
    int stiffSteps = 0;  // for so many steps on its group is solved at once; < 0: is not
    int strainedTicks = 0;                 // ticks on end that soft rows would have given way too far
    double angle = 0;                      // of B against A, turns counted, reference taken off   [rad]
    bool broken = false;
    double overTime = 0;  // for how long it has been over what breaks it   [s]
    double angleA = 0;  // of a gear: A's own, turns counted                        [rad]
    double notch = 0;  // of a ratchet: the number of the last tooth passed
    bool held[JointSlot::kLimits] = {};  // by each of its limits, at the end of the last tick

    // Of a joint of one's own.
    std::vector<std::uint32_t> more;  // slots of its bodies beyond two
    std::vector<CountedAngle> angles;  // by body
    std::uint32_t layout = 0;  // what rows it has: layoutOf(ConstraintRows)

    // Carried from tick to tick and from step to step.
    real impulses[JointSlot::kCount] = {};  // of the last tick   [N*s] or [N*m*s]

    // Summed over the step.
    Vec2 stepImpulse;  // on B                        [N*s]
    real stepTurn = 0;  // on B beside that impulse    [N*m*s]
    real stepSums[JointSlot::kCount] = {};  // of each row                 [N*s] or [N*m*s]
    double stepWork = 0;  // of the motor                [J]

    // Measured at the end of the step.
    JointReading reading;

    bool acts() const { return def.enabled; }
    /// Does it act on how its bodies move?
    bool ties() const { return acts() && !std::holds_alternative<FilterJoint>(def.kind); }

    void forgetLoads() { std::fill(std::begin(impulses), std::end(impulses), real(0)); }

    /// Each of its bodies, once, in the order in which they were given: slots.
    template <class Visit>
    void eachBody(Visit visit) const
    {
        visit(bodyA);
        if (bodyB != bodyA) visit(bodyB);
        for (const std::uint32_t body : more) visit(body);
    }
};

/// The joints of a world; a row is the slot of the joint's id.
struct JointTable {
    explicit JointTable(std::uint32_t world) : ids(world) {}

    IdPool<JointId> ids;
    std::vector<JointRow> rows;
    // By body slot, up to the last body that has had some: slots of its joints, in order of creation.
    std::vector<std::vector<std::uint32_t>> ofBody;
    // Of joints, of what they are tied to and of what is to be solved at once: so often something has changed
    // that is kept from step to step.
    std::uint64_t changes = 0;

    std::span<const std::uint32_t> of(std::uint32_t body) const
    {
        if (body >= ofBody.size()) return {};
        return ofBody[body];
    }
    void tie(std::uint32_t body, std::uint32_t joint)
    {
        if (body >= ofBody.size()) ofBody.resize(body + 1);
        ofBody[body].push_back(joint);
    }
};

/// Pairs of bodies that do not collide as a joint says so; sorted, lower slot first.
using UncoupledPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

}  // namespace tamias2d::inline TAMIAS_PRECISION
