// SPDX-License-Identifier: MIT
#include "joints/rows.hpp"

#include <tamias2d/math/scalar.hpp>

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr real kFade = Softness::kFade, kFirm = Softness::kFirm, kLoose = Softness::kLoose;

// How an impulse along one row moves another.
real complianceAlong(const Jacobian& j, const Jacobian& k, const Motion& a, const Motion& b)
{
    return a.invMass.x * j.linearA.x * k.linearA.x + a.invMass.y * j.linearA.y * k.linearA.y +
           a.invInertia * j.turnA * k.turnA + b.invMass.x * j.linearB.x * k.linearB.x +
           b.invMass.y * j.linearB.y * k.linearB.y + b.invInertia * j.turnB * k.turnB;
}

// What a body beyond two adds to that.
real complianceOf(const MoreBodies& more, int i, int k, int body, const Motion& m)
{
    const ConstraintRows::Part &p = more.parts[i][body], &q = more.parts[k][body];
    return m.invMass.x * p.linear.x * q.linear.x + m.invMass.y * p.linear.y * q.linear.y +
           m.invInertia * p.turn * q.turn;
}

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

// The inverse of a symmetric block of up to three rows. A row that nothing moves, or that others
// already settle, gets no impulse.
void invertBlock(const real (&k)[3][3], int count, real (&inverse)[3][3])
{
    real lower[3][3] = {}, pivot[3] = {};
    for (int i = 0; i < count; ++i) {
        for (int c = 0; c < i; ++c) {
            real sum = k[i][c];
            for (int m = 0; m < c; ++m) sum -= lower[i][m] * lower[c][m] * pivot[m];
            lower[i][c] = pivot[c] > 0 ? sum / pivot[c] : real(0);
        }
        real sum = k[i][i];
        for (int m = 0; m < i; ++m) sum -= lower[i][m] * lower[i][m] * pivot[m];
        pivot[i] = sum > real(1e-5) * k[i][i] ? sum : real(0);
    }
    for (int column = 0; column < count; ++column) {
        real x[3] = {};
        for (int i = 0; i < count; ++i) {
            x[i] = i == column ? real(1) : real(0);
            for (int m = 0; m < i; ++m) x[i] -= lower[i][m] * x[m];
        }
        for (int i = 0; i < count; ++i) x[i] = pivot[i] > 0 ? x[i] / pivot[i] : real(0);
        for (int i = count - 1; i >= 0; --i)
            for (int m = i + 1; m < count; ++m) x[i] -= pivot[i] > 0 ? lower[m][i] * x[m] : real(0);
        for (int i = 0; i < count; ++i) inverse[i][column] = x[i];
    }
}

bool isBounded(const ConstraintRow& row)
{
    return row.kind == RowKind::Motor || row.kind == RowKind::Spring;
}

// Does the spring swing too fast to be followed?
bool isFast(const ConstraintRow& row, real h)
{
    return row.stiffness * row.mass * h * h > kFastSpring * kFastSpring;
}

// A spring before the drift: halved, with the force of the middle of the tick [eq. 8]; whole, with that of
// its start; a fast one with that of its end [eq. 9].
void aimSpring(const ConstraintRow& row, RowVisit& visit, real curve, bool whole, real h)
{
    const real time = whole ? h : h / 2;
    const real when = isFast(row, h) ? h : whole ? real(0) : h / 2;
    visit.push = time * row.stiffness * (row.error + when * curve);
    visit.give = time * (row.damping + row.stiffness * when);
}

// And after it: the same force through all of the tick; a fast one is asked again.
void settleSpring(const ConstraintRow& row, RowVisit& visit, real h)
{
    const bool fast = isFast(row, h);
    visit.push = fast ? h / 2 * row.stiffness * row.error : -visit.first;
    visit.give = fast ? h / 2 * (row.damping + row.stiffness * h) : real(0);
}

}  // namespace

ConstraintRow& JointRows::add(RowKind kind, int slot, const Jacobian& j, real error, bool angular)
{
    ConstraintRow& row = rows[count++];
    row = {};
    row.kind = kind;
    row.slot = static_cast<std::uint8_t>(slot);
    row.j = j;
    row.error = error;
    row.angular = angular;
    if (kind == RowKind::Rigid) rigid = count;
    return row;
}

void prepareRows(JointRows& joint, const Table<Motion>& motions)
{
    const Motion &a = motions[joint.rowA], &b = motions[joint.rowB];
    joint.reach = maximum(a.extent, b.extent);
    for (int i = 0; i < joint.count; ++i)
        joint.rows[i].mass = complianceAlong(joint.rows[i].j, joint.rows[i].j, a, b);
    real k[3][3] = {};
    for (int i = 0; i < joint.rigid; ++i)
        for (int c = 0; c < joint.rigid; ++c)
            k[i][c] = complianceAlong(joint.rows[i].j, joint.rows[c].j, a, b);
    for (int m = 0; joint.more && m < joint.more->count; ++m) {
        const Motion& body = motions[joint.more->rows[m]];
        joint.reach = maximum(joint.reach, body.extent);
        for (int i = 0; i < joint.count; ++i) joint.rows[i].mass += complianceOf(*joint.more, i, i, m, body);
        for (int i = 0; i < joint.rigid; ++i)
            for (int c = 0; c < joint.rigid; ++c) k[i][c] += complianceOf(*joint.more, i, c, m, body);
    }
    invertBlock(k, joint.rigid, joint.inverse);
}

void startRows(JointRows& joint, const JointRow& carried, const StepContext& context)
{
    const real time = joint.whole ? context.h : context.h / 2;
    for (int i = 0; i < joint.count; ++i) {
        const ConstraintRow& row = joint.rows[i];
        RowVisit& visit = joint.visits[i];
        visit = {};
        visit.impulse = (joint.whole ? real(1) : real(0.5)) * carried.impulses[row.slot];
        visit.high = isBounded(row) ? row.most * time : kUnlimited;
        visit.low = row.kind == RowKind::Limit ? real(0) : -visit.high;
    }
}

real predictedGive(const ConstraintRow& row, real impulse, real h)
{
    return giveOf(row.mass, absolute(impulse), h);
}

namespace {

// Speed at which an error is to fade.
real fadeOf(const JointRows& joint, int i, const StepContext& context)
{
    const ConstraintRow& row = joint.rows[i];
    const bool open = row.kind == RowKind::Limit && row.error > 0;
    const real part = joint.visits[i].soft ? kFade : real(1);
    const real most = kReturn * (row.angular ? real(1) : context.lengthUnit);
    const real fade = part * row.error * context.invH;
    return open ? fade : clamp(fade, -most, most);
}

}  // namespace

template <class Bodies>
real aimRows(JointRows& joint, const JointRows& ahead, const Bodies& bodies, const StepContext& context)
{
    real most = 0;
    for (int i = 0; i < joint.count; ++i) {
        const ConstraintRow& row = joint.rows[i];
        RowVisit& visit = joint.visits[i];
        // What the way to `ahead` changes beyond the speed along the row, as that turns meanwhile.
        const real curve = (ahead.rows[i].error - row.error) * context.invH - speedOf(joint, i, bodies);
        const bool holds = row.kind == RowKind::Rigid || (row.kind == RowKind::Limit && row.error <= 0);
        visit.soft = holds && !joint.rigidly;
        if (row.kind == RowKind::Spring) {
            aimSpring(row, visit, curve, joint.whole, context.h);
        } else if (row.kind == RowKind::Motor) {
            visit.bias = -row.speed;
        } else {
            const real bias = curve + fadeOf(joint, i, context);
            most = maximum(most, absolute(bias - visit.bias) * (row.angular ? joint.reach : real(1)));
            visit.bias = bias;
        }
    }
    return most;
}

template real aimRows(JointRows&, const JointRows&, const BodyPair&, const StepContext&);
template real aimRows(JointRows&, const JointRows&, const BodySet&, const StepContext&);

void flattenRows(JointRows& joint, const StepContext& context)
{
    for (int i = 0; i < joint.count; ++i) {
        const RowKind kind = joint.rows[i].kind;
        const bool open = kind == RowKind::Limit && joint.rows[i].error > 0;
        if (kind == RowKind::Rigid || kind == RowKind::Limit)
            joint.visits[i].bias = open ? fadeOf(joint, i, context) : real(0);
    }
}

void settleRows(JointRows& joint, const StepContext& context)
{
    for (int i = 0; i < joint.count; ++i) {
        const ConstraintRow& row = joint.rows[i];
        RowVisit& visit = joint.visits[i];
        visit.first = visit.impulse;
        if (joint.lost) visit.impulse = 0;
        visit.soft = false;
        if (joint.whole) {  // all has acted: what brought errors back is taken out of the velocities again
            const bool bears = row.kind == RowKind::Limit && visit.first > 0;
            visit.impulse = visit.bias = visit.push = visit.give = 0;
            visit.low = bears ? -visit.first : row.kind == RowKind::Rigid ? -kUnlimited : real(0);
            visit.high = bears || row.kind == RowKind::Rigid ? kUnlimited : real(0);
            continue;
        }
        visit.bias = row.kind == RowKind::Motor ? -row.speed : real(0);
        if (row.kind == RowKind::Limit && !(visit.first > 0)) visit.high = 0;  // not reached: it may not push
        if (row.kind == RowKind::Spring) settleSpring(row, visit, context.h);
    }
}

namespace {

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
        wanted = (1 - kLoose) * visit.impulse - kFirm * (speed + visit.bias) / row.mass;
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
        const real left = visit.soft ? kFirm * wrong[i] + kLoose * visit.impulse * row.mass : wrong[i];
        most = maximum(most, row.angular ? absolute(left) * joint.reach : absolute(left));
        if (visit.soft) wrong[i] *= kFirm;
    }
    for (int i = 0; i < joint.rigid; ++i) {
        const RowVisit& visit = joint.visits[i];
        for (int c = 0; c < joint.rigid; ++c) change[i] -= joint.inverse[i][c] * wrong[c];
        if (visit.soft) change[i] -= kLoose * visit.impulse;
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
