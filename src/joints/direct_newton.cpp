// SPDX-License-Identifier: MIT
// The steps of Newton's method, and how far each of them goes.

#include "joints/direct_solver.hpp"

#include <tamias2d/math/scalar.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr int kMostSteps = 40;   // for one set of impulses before
constexpr double kSame = 1e-4;   // times what is negligible: a step that is none
constexpr double kTurned = 1e-9;  // of a speed: what may be left where a force turns under its bound
constexpr double kLeft = 1e-5;  // of the speeds: where rows that bear next to nothing go from bound to bound
constexpr double kRough = 1e-4;  // the same on the way to a harder rope
constexpr int kMostTrials = 20;  // of the length of a step
constexpr double kEven = 1e-6, kEvenEnough = 1e-1;  // of the descent at its start, there; with contacts

double greatest(const std::vector<double>& numbers)
{
    double most = 0;
    for (const double x : numbers) most = maximum(most, absolute(x));
    return most;
}

}  // namespace

bool DirectSolver::converge()
{
    answer();
    const double left = gammas_.ropes > DirectGammas::kRope ? kRough : kLeft;
    for (int step = 0; step < kMostSteps; ++step) {
        ++steps_;
        if (!factor()) return false;
        residual(group.step);
        group.matrix.solve(group.step);
        move(1);
        if (answer() && !turns_) return true;
        const double most = greatest(group.step);
        shorten();
        if (most <= enough(left)) return true;
    }
    return false;
}

// A change of speeds that ends Newton's method.
double DirectSolver::enough(double left) const
{
    if (!group.contacts.empty()) return kSame * gammas_.looseness * group.negligible;
    return turns_ ? kTurned : left * greatest(group.velocity);
}

// The impulses that the rows answer to the velocity at hand; true if each is as free as it was, or at the
// same bound.
bool DirectSolver::answer()
{
    bool same = true;
    turns_ = false;
    for (std::size_t j = 0; j < count(); ++j) {
        JointRows& rows = joint(j);
        double wanted[JointRows::kMost];
        std::uint16_t states = 0;
        for (int i = 0; i < rows.count; ++i) {
            const ConstraintRow& row = rows.rows[i];
            const RowVisit& visit = rows.visits[i];
            wanted[i] = wantedBy(j, i);
            const double low = static_cast<double>(visit.low), high = static_cast<double>(visit.high);
            impulse(j, i) = clamp(wanted[i], low, high);
            const bool isHigh = wanted[i] >= high || !(low < high);
            const unsigned state = isHigh ? AtHigh : wanted[i] <= low ? AtLow : Free;
            states = static_cast<std::uint16_t>(states | state << 2 * i);
            if (!row.pairBound) continue;
            const bool bound = length(DVec2{wanted[i - 1], wanted[i]}) > high;
            answerPair(j, i, wanted);
            states = static_cast<std::uint16_t>((states & ~(15u << 2 * (i - 1))) |
                                                (bound ? Together * 5u : Free * 5u) << 2 * (i - 1));
            turns_ = turns_ || bound;
        }
        same = same && states == group.states[j];
        group.states[j] = states;
    }
    return same;
}

// The two impulses of one force, whose strength is bounded.
void DirectSolver::answerPair(std::size_t j, int second, const double (&wanted)[JointRows::kMost])
{
    const DVec2 both{wanted[second - 1], wanted[second]};
    const double strength = length(both), high = static_cast<double>(joint(j).visits[second].high);
    const double part = strength > high ? high / strength : 1;
    impulse(j, second - 1) = part * both.x;
    impulse(j, second) = part * both.y;
}

// M (start - v) + sum of J^T (impulse - impulse at hand): zero where the velocity is that of the impulses.
void DirectSolver::residual(std::vector<double>& out)
{
    out.resize(group.start.size());
    for (std::size_t n = 0; n < group.rows.size(); ++n) {
        double mass[3];
        fillMasses(motions[group.rows[n]], mass);
        for (std::size_t i = 0; i < 3; ++i)
            out[3 * n + i] = mass[i] * (group.start[3 * n + i] - group.velocity[3 * n + i]);
        if (!group.turnStiffness.empty())
            out[3 * n + 2] -= group.turnStiffness[n] * group.velocity[3 * n + 2];
    }
    for (std::size_t j = 0; j < count(); ++j) {
        const JointRows& rows = joint(j);
        for (int i = 0; i < rows.count; ++i) {
            const double before = guarded_ ? 0 : static_cast<double>(rows.visits[i].impulse);
            addAlongRow(j, i, impulse(j, i) - before, out);
        }
        if (rows.turnMass > 0)
            addAlong(j, rows.across, -static_cast<double>(rows.turnMass) * speed(j, rows.across), out);
    }
}

void DirectSolver::move(double part)
{
    for (std::size_t i = 0; i < group.step.size(); ++i) group.velocity[i] += part * group.step[i];
}

// How fast what is minimized falls along the step, at the velocity at hand.
double DirectSolver::descent()
{
    residual(group.left);
    double sum = 0;
    for (std::size_t i = 0; i < group.step.size(); ++i) sum += group.left[i] * group.step[i];
    return sum;
}

// Where bounds were met the whole step may lead uphill: goes back to where along it the lowest place is. The
// descent falls in straight pieces, so false position finds it; an end that stays twice counts half.
void DirectSolver::shorten()
{
    double end = descent();
    if (!(end < 0)) return;
    move(-1);
    answer();
    double begin = descent(), low = 0, high = 1, at = 0;
    const double enough = (group.contacts.empty() ? kEven : kEvenEnough) * begin;
    int side = 0;
    for (int trial = 0; trial < kMostTrials && begin > end; ++trial) {
        const double next = low + (high - low) * begin / (begin - end);
        move(next - at);
        at = next;
        answer();
        const double now = descent();
        if (absolute(now) <= enough) return;
        if (now > 0) {
            low = at;
            begin = now;
            if (side > 0) end /= 2;
            side = 1;
        } else {
            high = at;
            end = now;
            if (side < 0) begin /= 2;
            side = -1;
        }
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
