// SPDX-License-Identifier: MIT
// From soft rows to hard ones: each set of impulses is where Newton's method begins the next.

#include "joints/direct_solver.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>
#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr int kMostOfAll = 60;  // steps, where there are contacts: then those do not get harder
constexpr double kLooseness[] = {1e4, 1e3, 1e2, 1e1, 1};  // times the gammas of contacts, one after the other

}  // namespace

bool DirectSolver::solve(const std::vector<BodyMotion<real>>& velocities)
{
    load(velocities);
    takeGammas({});
    const bool solved =
        group.contacts.empty() ? repeat(kRepeats) || (hasRopes() && soften(velocities)) : solveContacts();
    if (solved && group.loops && !takeLeastLoads()) return false;
    return solved && std::all_of(group.velocity.begin(), group.velocity.end(),
                                 [](double v) { return std::isfinite(v); });
}

// Factors are of the gammas with which they were made.
void DirectSolver::takeGammas(const DirectGammas& gammas)
{
    gammas_ = gammas;
    group.factored.clear();
}

// Newton's method from impulses to impulses; the last it found are at hand.
bool DirectSolver::repeat(int times)
{
    for (int i = 0; i < times; ++i) {
        if (!converge()) return false;
        group.before = group.impulses;
        boundFrictions();
    }
    return true;
}

// Where many contacts open and close, they give way at first, and then less and less, until that changes
// nothing more: so each begins near its answer. The hardest that was found counts.
bool DirectSolver::solveContacts()
{
    bool found = false;
    steps_ = 0;
    for (const double looseness : kLooseness) {
        if (steps_ >= kMostOfAll) break;
        takeGammas({.looseness = looseness});
        group.kept = group.velocity;
        if (!converge()) {
            group.velocity = group.kept;
            group.impulses = group.before;
            break;
        }
        found = true;
        const double left = violation();
        group.before = group.impulses;
        boundFrictions();
        if (left <= group.negligible) break;
    }
    return found;
}

// How fast what should not move does, at most: that is what changes impulses.
double DirectSolver::violation()
{
    double most = 0;
    for (std::size_t j = group.joints.size(); j < count(); ++j) {
        const JointRows& rows = joint(j);
        for (int i = 0; i < rows.count; ++i) {
            const double change = impulse(j, i) - before(j, i);
            const double gamma = gammas_.of(rows.rows[i]) * static_cast<double>(rows.rows[i].mass);
            most = maximum(most, gamma * absolute(change));
        }
    }
    return most;
}

bool DirectSolver::hasRopes()
{
    for (std::size_t j = 0; j < count(); ++j)
        for (int i = 0; i < joint(j).count; ++i)
            if (joint(j).rows[i].bears) return true;
    return false;
}

// Ropes that give way as much as other limits do, and then less and less, as long as that can be solved.
bool DirectSolver::soften(const std::vector<BodyMotion<real>>& velocities)
{
    load(velocities);
    takeGammas({.ropes = DirectGammas::kBounded});
    if (!repeat(1)) return false;
    while (gammas_.ropes > 2 * DirectGammas::kRope) {
        takeGammas({.ropes = gammas_.ropes / 10});
        group.kept = group.velocity;
        if (repeat(1)) continue;
        group.velocity = group.kept;
        group.impulses = group.before;
        break;
    }
    return true;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
