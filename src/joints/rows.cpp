// SPDX-License-Identifier: MIT
// What rows are asked for in a tick, before the drift and after it.

#include "joints/rows.hpp"

#include <tamias2d/math/scalar.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

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

// Speed at which an error is to fade.
real fadeOf(const JointRows& joint, int i, const StepContext& context)
{
    const ConstraintRow& row = joint.rows[i];
    const bool open = row.kind == RowKind::Limit && row.error > 0;
    const real part = joint.visits[i].soft ? Softness::kFade : joint.mildly ? kMildFade : real(1);
    const real most = kReturn * (row.angular ? real(1) : context.lengthUnit);
    const real fade = part * row.error * context.invH;
    return open ? fade : clamp(fade, -most, most);
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

real predictedGive(const ConstraintRow& row, real impulse, real h)
{
    return giveOf(row.mass, absolute(impulse), h);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
