// SPDX-License-Identifier: MIT
// What a solve of a group begins with, and what it leaves behind.

#include "joints/direct.hpp"

#include "joints/direct_solver.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {

real solveDirect(DirectGroup& group, std::vector<JointRows>& all, const Table<Motion>& motions,
                 std::vector<BodyMotion<real>>& velocities)
{
    DirectSolver solver({group, all, motions});
    if (!solver.solve(velocities)) return -1;
    real change = 0;
    solver.store(velocities, change);
    return change;
}

void DirectSolver::load(const std::vector<BodyMotion<real>>& velocities)
{
    const std::size_t nodes = group.rows.size();
    group.start.resize(3 * nodes);
    for (std::size_t n = 0; n < nodes; ++n) {
        // What the kicks have rounded is still known where no visit has changed it.
        const auto known = [](real velocity, double fine) {
            return static_cast<real>(fine) == velocity ? fine : static_cast<double>(velocity);
        };
        const Motion& m = motions[group.rows[n]];
        group.start[3 * n] = known(velocities[n].velocity.x, m.fineVelocity.x);
        group.start[3 * n + 1] = known(velocities[n].velocity.y, m.fineVelocity.y);
        group.start[3 * n + 2] = known(velocities[n].spin, m.fineSpin);
    }
    group.velocity = group.start;
    guarded_ = std::any_of(group.joints.begin(), group.joints.end(),
                           [&](std::uint32_t j) { return all[j].turnMass > 0; });
    if (guarded_) takeBack();
    group.states.assign(count(), 0xffff);
    group.factored.clear();
    group.impulses.assign(count() * JointRows::kMost, 0);
    for (std::size_t j = 0; j < count(); ++j)
        for (int i = 0; i < joint(j).count; ++i)
            impulse(j, i) = static_cast<double>(joint(j).visits[i].impulse);
    group.before = group.impulses;
    boundFrictions();
}

// What presses bounds what rubs: for one set of impulses before, by those.
void DirectSolver::boundFrictions()
{
    const std::size_t joints = group.joints.size();
    for (std::size_t j = joints; j < count(); ++j) {
        JointRows& rows = joint(j);
        for (int i = 0; i < rows.count; ++i) {
            if (rows.rows[i].pressedBy == 0) continue;
            double load = 0;
            for (int k = 0; k < rows.count; ++k)
                if ((rows.rows[i].pressedBy >> k & 1) != 0) load += before(j, k);
            rows.visits[i].high = rows.rows[i].most * static_cast<real>(load);
            rows.visits[i].low = -rows.visits[i].high;
        }
    }
}

// The velocities without what the group itself has changed in this half of the tick.
void DirectSolver::takeBack()
{
    std::vector<double>& given = group.given;
    if (group.begins) {  // what was carried
        given.assign(group.start.size(), 0);
        for (std::size_t j = 0; j < count(); ++j)
            for (int i = 0; i < joint(j).count; ++i)
                addAlongRow(j, i, static_cast<double>(joint(j).visits[i].impulse), given);
        for (std::size_t n = 0; n < group.rows.size(); ++n) {
            double mass[3];
            fillMasses(motions[group.rows[n]], mass);
            for (std::size_t i = 0; i < 3; ++i) given[3 * n + i] /= mass[i];
        }
    }
    for (std::size_t i = 0; i < given.size(); ++i) group.start[i] -= given[i];
}

void DirectSolver::store(std::vector<BodyMotion<real>>& velocities, real& change)
{
    if (guarded_)
        for (std::size_t i = 0; i < group.given.size(); ++i)
            group.given[i] = group.velocity[i] - group.start[i];
    group.begins = false;
    // What the impulses make of the velocities, as those that are kept are the impulses.
    for (std::size_t j = 0; j < count(); ++j)
        for (int i = 0; i < joint(j).count; ++i)
            joint(j).visits[i].impulse = static_cast<real>(impulse(j, i));
    // What rounding takes from the momentum of one, the next gets that it does not shift by more than its own
    // rounding does: so the momentum of all is rounded once.
    constexpr double kUlp = static_cast<double>(std::numeric_limits<real>::epsilon());
    double owedX = 0, owedY = 0;  // [kg*m/s]
    const auto rounded = [](double velocity, real inverse, double& owed) {
        const double given = owed * static_cast<double>(inverse);
        const bool takes = absolute(given) <= 2 * kUlp * absolute(velocity);
        const double exact = takes ? velocity + given : velocity;
        const real nearest = static_cast<real>(exact);
        owed = (takes ? 0 : owed) + (exact - static_cast<double>(nearest)) / static_cast<double>(inverse);
        return nearest;
    };
    for (std::size_t n = 0; n < group.rows.size(); ++n) {
        const Motion& m = motions[group.rows[n]];
        const double* v = &group.velocity[3 * n];
        const Vec2 linear{m.invMass.x > 0 ? rounded(v[0], m.invMass.x, owedX) : velocities[n].velocity.x,
                          m.invMass.y > 0 ? rounded(v[1], m.invMass.y, owedY) : velocities[n].velocity.y};
        const real spin = m.invInertia > 0 ? static_cast<real>(v[2]) : velocities[n].spin;
        change = maximum(change, maximum(length(linear - velocities[n].velocity),
                                         absolute(spin - velocities[n].spin) * m.extent));
        velocities[n] = {linear, spin};
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
