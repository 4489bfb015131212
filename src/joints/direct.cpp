// SPDX-License-Identifier: MIT
// Newton's method on the impulses of a group. Each row answers a velocity by the impulse
//     clamp(before - (J v + b)/gamma, low, high)
// which for gamma = 0 would be the rigid row; a small gamma keeps redundant rows apart, and as it acts on the
// change of an impulse only, nothing sags.

#include "joints/direct.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>
#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr double kRigid = 1e-7, kBounded = 1e-2;  // gamma over the effective mass inverted
constexpr int kMostSteps = 16;  // of Newton's method, for one set of impulses before
constexpr int kRepeats = 3;  // of the whole, each from the impulses of the last

// What a row answers: its impulse is `at - slope * (J v)`, held within its bounds.
struct Answer {
    double at = 0, slope = 0;
};

Answer answerOf(const ConstraintRow& row, const RowVisit& visit, double before)
{
    if (row.kind == RowKind::Spring)
        return {-static_cast<double>(visit.push), static_cast<double>(visit.give)};
    const double gamma = (row.kind == RowKind::Rigid ? kRigid : kBounded) * static_cast<double>(row.mass);
    if (!(gamma > 0)) return {};
    return {before - static_cast<double>(visit.bias) / gamma, 1 / gamma};
}

class DirectSolver {
public:
    DirectSolver(DirectGroup& group, std::vector<JointRows>& all, const std::vector<Motion>& motions)
        : group_(group), all_(all), motions_(motions)
    {
    }

    bool solve(const std::vector<BodyMotion<real>>& velocities);
    void store(std::vector<BodyMotion<real>>& velocities, real& change);

private:
    DirectGroup& group_;
    std::vector<JointRows>& all_;
    const std::vector<Motion>& motions_;

    JointRows& joint(std::size_t j) { return all_[group_.joints[j]]; }
    double& impulse(std::size_t j, int i)
    {
        return group_.impulses[j * JointRows::kMost + static_cast<std::size_t>(i)];
    }

    void load(const std::vector<BodyMotion<real>>& velocities);
    double speed(std::size_t j, const ConstraintRow& row) const;
    bool answer();
    bool factor();
    void residual(std::vector<double>& out);
    bool converge();
    void addRow(const ConstraintRow& row, int nodeA, int nodeB, double weight);
};

// A locked axis takes no part: its row of the Jacobian is left out, its mass any.
void fillJacobian(const Jacobian& j, const Motion& a, const Motion& b, double (&onA)[3], double (&onB)[3])
{
    onA[0] = a.invMass.x > 0 ? static_cast<double>(j.linearA.x) : 0;
    onA[1] = a.invMass.y > 0 ? static_cast<double>(j.linearA.y) : 0;
    onA[2] = a.invInertia > 0 ? static_cast<double>(j.turnA) : 0;
    onB[0] = b.invMass.x > 0 ? static_cast<double>(j.linearB.x) : 0;
    onB[1] = b.invMass.y > 0 ? static_cast<double>(j.linearB.y) : 0;
    onB[2] = b.invInertia > 0 ? static_cast<double>(j.turnB) : 0;
}

void fillMasses(const Motion& m, double (&mass)[3])
{
    const real inverse[3] = {m.invMass.x, m.invMass.y, m.invInertia};
    for (int i = 0; i < 3; ++i) mass[i] = inverse[i] > 0 ? 1 / static_cast<double>(inverse[i]) : 1;
}

void DirectSolver::load(const std::vector<BodyMotion<real>>& velocities)
{
    const std::size_t nodes = group_.rows.size();
    group_.start.resize(3 * nodes);
    for (std::size_t n = 0; n < nodes; ++n) {
        group_.start[3 * n] = static_cast<double>(velocities[n].velocity.x);
        group_.start[3 * n + 1] = static_cast<double>(velocities[n].velocity.y);
        group_.start[3 * n + 2] = static_cast<double>(velocities[n].spin);
    }
    group_.velocity = group_.start;
    group_.active.assign(group_.joints.size(), 0xff);
    group_.factored.clear();
    group_.impulses.assign(group_.joints.size() * JointRows::kMost, 0);
    for (std::size_t j = 0; j < group_.joints.size(); ++j)
        for (int i = 0; i < joint(j).count; ++i)
            impulse(j, i) = static_cast<double>(joint(j).visits[i].impulse);
    group_.before = group_.impulses;
}

double DirectSolver::speed(std::size_t j, const ConstraintRow& row) const
{
    const auto part = [&](int node, std::uint32_t motion, Vec2 linear, real turn) {
        const double spin = static_cast<double>(turn);
        if (node < 0) {
            const Motion& m = motions_[motion];
            return static_cast<double>(dot(linear, m.velocity)) + spin * static_cast<double>(m.spin);
        }
        const double* v = &group_.velocity[3 * static_cast<std::size_t>(node)];
        return static_cast<double>(linear.x) * v[0] + static_cast<double>(linear.y) * v[1] + spin * v[2];
    };
    const JointRows& rows = all_[group_.joints[j]];
    const auto [a, b] = group_.nodes[j];
    return part(a, rows.rowA, row.j.linearA, row.j.turnA) + part(b, rows.rowB, row.j.linearB, row.j.turnB);
}

// The impulses that the rows answer to the velocity at hand; true if each is as free or as bound as it was.
bool DirectSolver::answer()
{
    bool same = true;
    for (std::size_t j = 0; j < group_.joints.size(); ++j) {
        JointRows& rows = joint(j);
        std::uint8_t free = 0;
        for (int i = 0; i < rows.count; ++i) {
            const ConstraintRow& row = rows.rows[i];
            const RowVisit& visit = rows.visits[i];
            const Answer a =
                answerOf(row, visit, group_.before[j * JointRows::kMost + static_cast<std::size_t>(i)]);
            const double wanted = a.at - a.slope * speed(j, row);
            const double low = static_cast<double>(visit.low), high = static_cast<double>(visit.high);
            impulse(j, i) = clamp(wanted, low, high);
            if (wanted > low && wanted < high) free |= static_cast<std::uint8_t>(1u << i);
            if (!row.pairBound) continue;
            const double strength = length(DVec2{impulse(j, i - 1), impulse(j, i)});
            if (!(strength > high)) continue;
            impulse(j, i - 1) *= high / strength;
            impulse(j, i) *= high / strength;
            free &= static_cast<std::uint8_t>(~(3u << (i - 1)));
        }
        same = same && free == group_.active[j];
        group_.active[j] = free;
    }
    return same;
}

void DirectSolver::addRow(const ConstraintRow& row, int nodeA, int nodeB, double weight)
{
    static const Motion ground;
    double onA[3], onB[3];
    const Motion& a = nodeA < 0 ? ground : motions_[group_.rows[static_cast<std::size_t>(nodeA)]];
    const Motion& b = nodeB < 0 ? ground : motions_[group_.rows[static_cast<std::size_t>(nodeB)]];
    fillJacobian(row.j, a, b, onA, onB);
    const auto add = [weight](BlockLdl::Block& block, const double (&x)[3], const double (&y)[3]) {
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) block.a[3 * r + c] += weight * x[r] * y[c];
    };
    if (nodeA >= 0) add(group_.matrix.diagonal(nodeA), onA, onA);
    if (nodeB >= 0) add(group_.matrix.diagonal(nodeB), onB, onB);
    if (nodeA < 0 || nodeB < 0) return;
    const auto [block, transposed] = group_.matrix.between(nodeA, nodeB);
    if (transposed)
        add(*block, onB, onA);
    else
        add(*block, onA, onB);
}

bool DirectSolver::factor()
{
    if (group_.factored == group_.active) return true;
    group_.matrix.clear();
    for (std::size_t n = 0; n < group_.rows.size(); ++n) {
        double mass[3];
        fillMasses(motions_[group_.rows[n]], mass);
        for (int i = 0; i < 3; ++i) group_.matrix.diagonal(static_cast<int>(n)).a[4 * i] = mass[i];
    }
    for (std::size_t j = 0; j < group_.joints.size(); ++j) {
        const JointRows& rows = joint(j);
        for (int i = 0; i < rows.count; ++i) {
            if (!(group_.active[j] >> i & 1)) continue;
            const double slope = answerOf(rows.rows[i], rows.visits[i], 0).slope;
            if (slope > 0) addRow(rows.rows[i], group_.nodes[j].first, group_.nodes[j].second, slope);
        }
    }
    group_.factored = group_.active;
    return group_.matrix.factor();
}

// M (start - v) + sum of J^T (impulse - impulse at hand): zero where the velocity is that of the impulses.
void DirectSolver::residual(std::vector<double>& out)
{
    out.resize(group_.start.size());
    for (std::size_t n = 0; n < group_.rows.size(); ++n) {
        double mass[3];
        fillMasses(motions_[group_.rows[n]], mass);
        for (std::size_t i = 0; i < 3; ++i)
            out[3 * n + i] = mass[i] * (group_.start[3 * n + i] - group_.velocity[3 * n + i]);
    }
    for (std::size_t j = 0; j < group_.joints.size(); ++j) {
        const JointRows& rows = joint(j);
        const auto [nodeA, nodeB] = group_.nodes[j];
        for (int i = 0; i < rows.count; ++i) {
            double onA[3], onB[3];
            fillJacobian(rows.rows[i].j, motions_[rows.rowA], motions_[rows.rowB], onA, onB);
            const double given = impulse(j, i) - static_cast<double>(rows.visits[i].impulse);
            for (std::size_t c = 0; c < 3; ++c) {
                if (nodeA >= 0) out[3 * static_cast<std::size_t>(nodeA) + c] += onA[c] * given;
                if (nodeB >= 0) out[3 * static_cast<std::size_t>(nodeB) + c] += onB[c] * given;
            }
        }
    }
}

bool DirectSolver::converge()
{
    answer();
    for (int step = 0; step < kMostSteps; ++step) {
        if (!factor()) return false;
        residual(group_.step);
        group_.matrix.solve(group_.step);
        for (std::size_t i = 0; i < group_.step.size(); ++i) group_.velocity[i] += group_.step[i];
        if (answer()) return true;
    }
    return false;
}

bool DirectSolver::solve(const std::vector<BodyMotion<real>>& velocities)
{
    load(velocities);
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
        if (!converge()) return false;
        group_.before = group_.impulses;
    }
    return std::all_of(group_.velocity.begin(), group_.velocity.end(),
                       [](double v) { return std::isfinite(v); });
}

void DirectSolver::store(std::vector<BodyMotion<real>>& velocities, real& change)
{
    // What the impulses make of the velocities, as those that are kept are the impulses.
    for (std::size_t j = 0; j < group_.joints.size(); ++j)
        for (int i = 0; i < joint(j).count; ++i)
            joint(j).visits[i].impulse = static_cast<real>(impulse(j, i));
    for (std::size_t n = 0; n < group_.rows.size(); ++n) {
        const Motion& m = motions_[group_.rows[n]];
        const double* v = &group_.velocity[3 * n];
        const Vec2 linear{m.invMass.x > 0 ? static_cast<real>(v[0]) : velocities[n].velocity.x,
                          m.invMass.y > 0 ? static_cast<real>(v[1]) : velocities[n].velocity.y};
        const real spin = m.invInertia > 0 ? static_cast<real>(v[2]) : velocities[n].spin;
        change = maximum(change, maximum(length(linear - velocities[n].velocity),
                                         absolute(spin - velocities[n].spin) * m.extent));
        velocities[n] = {linear, spin};
    }
}

}  // namespace

void DirectGroup::build(const std::vector<JointRows>& all, const std::vector<Motion>& motions)
{
    rows.clear();
    for (const std::uint32_t j : joints)
        for (const std::uint32_t row : {all[j].rowA, all[j].rowB})
            if (motions[row].moves()) rows.push_back(row);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    const auto nodeOf = [&](std::uint32_t row) {
        if (!motions[row].moves()) return -1;
        return static_cast<int>(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin());
    };
    nodes.clear();
    edges.clear();
    for (const std::uint32_t j : joints) {
        nodes.emplace_back(nodeOf(all[j].rowA), nodeOf(all[j].rowB));
        if (nodes.back().first >= 0 && nodes.back().second >= 0) edges.push_back(nodes.back());
    }
    const int count = static_cast<int>(rows.size());
    if (count == analyzedNodes && edges == analyzed) return;
    matrix.analyze(count, edges);
    analyzedNodes = count;
    analyzed.swap(edges);
}

real solveDirect(DirectGroup& group, std::vector<JointRows>& all, const std::vector<Motion>& motions,
                 std::vector<BodyMotion<real>>& velocities)
{
    DirectSolver solver(group, all, motions);
    if (!solver.solve(velocities)) return -1;
    real change = 0;
    solver.store(velocities, change);
    return change;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
