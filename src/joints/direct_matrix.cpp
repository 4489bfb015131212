// SPDX-License-Identifier: MIT
// The matrix of a step: masses, and what the rows that are free add to them.

#include "joints/direct_solver.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

TAMIAS_INLINE void addProduct(BlockLdl::Block& block, double weight, const double (&x)[3],
                              const double (&y)[3])
{
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) block.a[3 * r + c] += weight * x[r] * y[c];
}

// Of two nodes, if something moves both; a body that is alone in its joint is there twice.
TAMIAS_INLINE void addBetween(BlockLdl& matrix, double weight, int nodeA, const double (&onA)[3], int nodeB,
                              const double (&onB)[3])
{
    if (nodeA < 0 || nodeB < 0 || nodeA == nodeB) return;
    const auto [block, transposed] = matrix.between(nodeA, nodeB);
    if (transposed)
        addProduct(*block, weight, onB, onA);
    else
        addProduct(*block, weight, onA, onB);
}

}  // namespace

bool DirectSolver::factor()
{
    if (group.factored == group.states && !turns_) return true;
    group.matrix.clear();
    for (std::size_t n = 0; n < group.rows.size(); ++n) {
        double mass[3];
        fillMasses(motions[group.rows[n]], mass);
        for (int i = 0; i < 3; ++i) group.matrix.diagonal(static_cast<int>(n)).a[4 * i] = mass[i];
        if (!group.turnStiffness.empty())
            group.matrix.diagonal(static_cast<int>(n)).a[8] += group.turnStiffness[n];
    }
    for (std::size_t j = 0; j < count(); ++j) addRows(j);
    group.factored = group.states;
    return group.matrix.factor();
}

void DirectSolver::addRows(std::size_t j)
{
    const JointRows& rows = joint(j);
    if (rows.turnMass > 0)
        addRow(rows.across, group.nodes[j].first, group.nodes[j].second, static_cast<double>(rows.turnMass));
    for (int i = 0; i < rows.count; ++i) {
        const unsigned state = group.states[j] >> 2 * i & 3u;
        if (state == Together && rows.rows[i].pairBound) addPair(j, i);
        if (state != Free) continue;
        const double slope = gammas_.answer(rows.rows[i], rows.visits[i], 0).slope;
        if (!(slope > 0)) continue;
        addRow(rows.rows[i].j, group.nodes[j].first, group.nodes[j].second, slope);
        if (rows.more) addMore(j, i, slope);
    }
}

// At its bound a force gives way across its direction only: what it turns by.
void DirectSolver::addPair(std::size_t j, int second)
{
    const JointRows& rows = joint(j);
    const ConstraintRow &x = rows.rows[second - 1], &y = rows.rows[second];
    const DVec2 force{impulse(j, second - 1), impulse(j, second)};
    const double strength = length(force);
    if (!(strength > 0)) return;
    const double part = strength / length(DVec2{wantedBy(j, second - 1), wantedBy(j, second)});
    const double slope = gammas_.answer(y, rows.visits[second], 0).slope * part;
    const auto alongX = static_cast<real>(-force.y / strength),
               alongY = static_cast<real>(force.x / strength);
    const Jacobian across{alongX * x.j.linearA + alongY * y.j.linearA,
                          alongX * x.j.linearB + alongY * y.j.linearB,
                          alongX * x.j.turnA + alongY * y.j.turnA, alongX * x.j.turnB + alongY * y.j.turnB};
    if (slope > 0) addRow(across, group.nodes[j].first, group.nodes[j].second, slope);
}

void DirectSolver::addRow(const Jacobian& jacobian, int nodeA, int nodeB, double weight)
{
    static const Motion ground;
    double onA[3], onB[3];
    const Motion& a = nodeA < 0 ? ground : motions[group.rows[static_cast<std::size_t>(nodeA)]];
    const Motion& b = nodeB < 0 ? ground : motions[group.rows[static_cast<std::size_t>(nodeB)]];
    fillJacobian(jacobian, a, b, onA, onB);
    if (nodeA >= 0) addProduct(group.matrix.diagonal(nodeA), weight, onA, onA);
    if (nodeB >= 0) addProduct(group.matrix.diagonal(nodeB), weight, onB, onB);
    addBetween(group.matrix, weight, nodeA, onA, nodeB, onB);
}

// What the bodies beyond two add to that.
void DirectSolver::addMore(std::size_t j, int i, double weight)
{
    const JointRows& rows = joint(j);
    const MoreBodies& more = *rows.more;
    int nodes[ConstraintRows::kMostBodies] = {group.nodes[j].first, group.nodes[j].second};
    double on[ConstraintRows::kMostBodies][3];
    fillJacobian(rows.rows[i].j, motions[rows.rowA], motions[rows.rowB], on[0], on[1]);
    for (int k = 0; k < more.count; ++k) {
        const int p = 2 + k;
        nodes[p] = moreNode(j, k);
        fillPart(more.parts[i][k], motions[more.rows[k]], on[p]);
        if (nodes[p] >= 0) addProduct(group.matrix.diagonal(nodes[p]), weight, on[p], on[p]);
        for (int q = 0; q < p; ++q) addBetween(group.matrix, weight, nodes[q], on[q], nodes[p], on[p]);
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
