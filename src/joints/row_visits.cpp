// SPDX-License-Identifier: MIT
// A visit to the rows of a joint: each answers the velocities at hand, what is rigid last.

#include "joints/row_masses.hpp"

#include <tamias2d/math/scalar.hpp>

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

real complianceBetween(const JointRows& joint, int i, int k, const BodyPair& bodies)
{
    return complianceAlong(joint.rows[i].j, joint.rows[k].j, bodies.a, bodies.b);
}
real complianceBetween(const JointRows& joint, int i, int k, const BodySet& bodies)
{
    real sum = complianceAlong(joint.rows[i].j, joint.rows[k].j, *bodies.motions[0], *bodies.motions[1]);
    for (int body = 2; body < bodies.count; ++body)
        sum += complianceOf(*joint.more, i, k, body - 2, *bodies.motions[body]);
    return sum;
}

template <class Bodies>
real solveOne(JointRows& joint, int i, Bodies& bodies)
{
    const ConstraintRow& row = joint.rows[i];
    RowVisit& visit = joint.visits[i];
    const real speed = speedOf(joint, i, bodies);
    real wanted = 0;
    if (row.kind == RowKind::Spring)
        wanted =
            (-visit.push - visit.give * (speed - row.mass * visit.impulse)) / (1 + visit.give * row.mass);
    else if (row.mass > 0 && visit.soft)
        wanted = (1 - Softness::kLoose) * visit.impulse - Softness::kFirm * (speed + visit.bias) / row.mass;
    else if (row.mass > 0)
        wanted = visit.impulse - (speed + visit.bias) / row.mass;
    const real total = clamp(wanted, visit.low, visit.high), change = total - visit.impulse;
    applyTo(joint, i, change, bodies);
    visit.impulse = total;
    return absolute(change) * row.mass;
}

// What the row's impulse x must be so that factor * x + weight * J v + rest = 0 if it is not bounded.
struct Demand {
    real factor, weight, rest;
};

Demand demandOf(const ConstraintRow& row, const RowVisit& visit)
{
    if (row.kind == RowKind::Spring) return {1, visit.give, visit.push};
    return {0, 1, visit.bias};
}

// Two rows of one force: asked together, and bounded by its strength.
template <class Bodies>
real solvePair(JointRows& joint, int second, Bodies& bodies)
{
    const ConstraintRow &x = joint.rows[second - 1], &y = joint.rows[second];
    RowVisit &ofX = joint.visits[second - 1], &ofY = joint.visits[second];
    const Demand p = demandOf(x, ofX), q = demandOf(y, ofY);
    const real between = complianceBetween(joint, second - 1, second, bodies);
    const real wrongX = p.factor * ofX.impulse + p.weight * speedOf(joint, second - 1, bodies) + p.rest;
    const real wrongY = q.factor * ofY.impulse + q.weight * speedOf(joint, second, bodies) + q.rest;
    const real xx = p.factor + p.weight * x.mass, yy = q.factor + q.weight * y.mass;
    const real xy = p.weight * between, yx = q.weight * between, determinant = xx * yy - xy * yx;
    real newX = ofX.impulse, newY = ofY.impulse;
    if (determinant > real(1e-6) * xx * yy) {
        newX -= (yy * wrongX - xy * wrongY) / determinant;
        newY -= (xx * wrongY - yx * wrongX) / determinant;
    } else if (xx > 0 || yy > 0) {  // one of them is all that can be moved
        if (xx >= yy)
            newX -= wrongX / xx;
        else
            newY -= wrongY / yy;
    }
    const double strength = length(DVec2{static_cast<double>(newX), static_cast<double>(newY)});
    const double high = static_cast<double>(ofY.high);
    if (strength > high) {
        newX = static_cast<real>(high / strength * static_cast<double>(newX));
        newY = static_cast<real>(high / strength * static_cast<double>(newY));
    }
    const real changeX = newX - ofX.impulse, changeY = newY - ofY.impulse;
    applyTo(joint, second - 1, changeX, bodies);
    applyTo(joint, second, changeY, bodies);
    ofX.impulse = newX;
    ofY.impulse = newY;
    return maximum(absolute(changeX) * x.mass, absolute(changeY) * y.mass);
}

// What is rigid comes last and together: it is to hold.
template <class Bodies>
real solveRigid(JointRows& joint, Bodies& bodies)
{
    real most = 0, change[3] = {}, wrong[3] = {};
    for (int i = 0; i < joint.rigid; ++i) {
        const ConstraintRow& row = joint.rows[i];
        const RowVisit& visit = joint.visits[i];
        wrong[i] = speedOf(joint, i, bodies) + visit.bias;
        const real left =
            visit.soft ? Softness::kFirm * wrong[i] + Softness::kLoose * visit.impulse * row.mass : wrong[i];
        most = maximum(most, row.angular ? absolute(left) * joint.reach : absolute(left));
        if (visit.soft) wrong[i] *= Softness::kFirm;
    }
    for (int i = 0; i < joint.rigid; ++i) {
        const RowVisit& visit = joint.visits[i];
        for (int c = 0; c < joint.rigid; ++c) change[i] -= joint.inverse[i][c] * wrong[c];
        if (visit.soft) change[i] -= Softness::kLoose * visit.impulse;
    }
    for (int i = 0; i < joint.rigid; ++i) {
        applyTo(joint, i, change[i], bodies);
        joint.visits[i].impulse += change[i];
    }
    return most;
}

template <class Bodies>
real visitRows(JointRows& joint, Bodies& bodies)
{
    real most = 0;
    for (int i = joint.rigid; i < joint.count; ++i) {
        const ConstraintRow& row = joint.rows[i];
        const bool isPair = i + 1 < joint.count && joint.rows[i + 1].pairBound;
        const real change = isPair ? solvePair(joint, ++i, bodies) : solveOne(joint, i, bodies);
        most = maximum(most, row.angular ? change * joint.reach : change);
    }
    return maximum(most, solveRigid(joint, bodies));
}

bool isFinite(const BodyMotion<real>& v)
{
    return isFinite(v.velocity) && std::isfinite(v.spin);
}
bool isFinite(const BodyPair& bodies)
{
    return isFinite(bodies.va) && isFinite(bodies.vb);
}
bool isFinite(const BodySet& bodies)
{
    bool all = true;
    for (int k = 0; k < bodies.count; ++k) all = all && isFinite(bodies.velocities[k]);
    return all;
}

void takeVelocities(BodyPair& bodies, const BodyPair& from)
{
    bodies.va = from.va;
    bodies.vb = from.vb;
}
void takeVelocities(BodySet& bodies, const BodySet& from)
{
    bodies = from;
}

}  // namespace

template <class Bodies>
real solveRows(JointRows& joint, Bodies& bodies)
{
    Bodies after = bodies;
    const real change = visitRows(joint, after);
    if (isFinite(after)) {
        takeVelocities(bodies, after);
        return change;
    }
    // Beyond all numbers: the joint lets go for this visit.
    for (RowVisit& visit : joint.visits) visit.impulse = 0;
    return 0;
}

template real solveRows(JointRows&, BodyPair&);
template real solveRows(JointRows&, BodySet&);

}  // namespace tamias2d::inline TAMIAS_PRECISION
