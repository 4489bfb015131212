// SPDX-License-Identifier: MIT
// Where loops tie bodies, rows repeat each other: loads that cancel may be of any size, do nothing, and grow
// by each residual that no motion can undo. docs/theory/joints.md, section 7.

#include "joints/direct_solver.hpp"

#include <tamias2d/math/scalar.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

// Of all impulses that change the velocities as those at hand do, the least ones: by steps from none at all,
// which stay in the space of what the rows do.
bool DirectSolver::takeLeastLoads()
{
    findBearing();
    if (!factor()) return false;
    group.before = group.impulses;  // what they have to do
    group.kept = group.velocity;
    group.speeds.clear();
    for (const std::uint32_t place : group.bearing) {
        group.speeds.push_back(speedOf(jointAt(place), rowAt(place)));
        group.impulses[place] = 0;
    }
    for (int time = 0; time < kRepeats; ++time) relax();
    group.velocity = group.kept;
    const double part = partToBounds();
    for (const std::uint32_t place : group.bearing)
        group.impulses[place] = group.before[place] + part * (group.impulses[place] - group.before[place]);
    return true;
}

// Rigid rows, and ropes that are taut: the others keep what they have.
void DirectSolver::findBearing()
{
    constexpr std::uint16_t kAllAtBounds = 0x5555 * AtHigh;
    group.bearing.clear();
    group.states.assign(count(), kAllAtBounds);
    turns_ = false;
    for (std::size_t j = 0; j < group.joints.size(); ++j)
        for (int i = 0; i < joint(j).count; ++i) {
            const ConstraintRow& row = joint(j).rows[i];
            const bool isTaut = row.kind == RowKind::Limit && row.bears && impulse(j, i) > 0;
            if (row.kind != RowKind::Rigid && !isTaut) continue;
            group.bearing.push_back(static_cast<std::uint32_t>(placeOf(j, i)));
            group.states[j] = static_cast<std::uint16_t>(group.states[j] & ~(3u << 2 * i));
        }
}

// One step: the impulses answer to the velocities that they leave wrong.
void DirectSolver::relax()
{
    group.step.assign(group.velocity.size(), 0);
    for (const std::uint32_t place : group.bearing)
        addAlongRow(jointAt(place), rowAt(place), group.impulses[place] - group.before[place], group.step);
    group.matrix.solve(group.step);
    for (std::size_t k = 0; k < group.step.size(); ++k) group.velocity[k] = group.kept[k] + group.step[k];
    for (std::size_t k = 0; k < group.bearing.size(); ++k) {
        const std::uint32_t place = group.bearing[k];
        const JointRows& rows = joint(jointAt(place));
        const int i = rowAt(place);
        const double slope = gammas_.answer(rows.rows[i], rows.visits[i], 0).slope;
        group.impulses[place] -= slope * (speedOf(jointAt(place), i) - group.speeds[k]);
    }
}

// How far the impulses may go from those before to those at hand: no rope pushes.
double DirectSolver::partToBounds() const
{
    double part = 1;
    for (const std::uint32_t place : group.bearing) {
        const double now = group.impulses[place], was = group.before[place];
        if (joint(jointAt(place)).rows[rowAt(place)].kind == RowKind::Limit && now < 0)
            part = minimum(part, was / (was - now));
    }
    return part;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
