// SPDX-License-Identifier: MIT
#include "contacts/update.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

// The deceleration -c v of damping holds for times well below 1/c only. Held at what takes all speed away in
// a tick, it leaves the path of a strongly damped body longer than it is, rather than backwards without end.
Vec2 expectedAcceleration(const Motion& m, real invH)
{
    return m.acceleration - minimum(m.damping.rate, invH) * m.velocity + invH * m.steady;
}

real expectedSpinRate(const Motion& m, real invH)
{
    return m.spinRate - minimum(m.spinDamping.rate, invH) * m.spin + invH * m.steadySpin;
}

Trajectory predictedPath(const Motion& m, Position origin, real invH)
{
    Trajectory path;
    path.position = toVec2(m.center - origin);
    path.angle = m.angle;
    path.rotation = m.rotation;
    path.velocity = m.velocity;
    path.spin = m.spin;
    if (m.moves()) {
        path.acceleration = expectedAcceleration(m, invH);
        // What rests is expected not to start turning: as a body glides over its supports, the torque of
        // the last tick says nothing about the next.
        const bool rests = m.steady != Vec2{} || m.steadySpin != 0;
        path.spinRate = rests ? real(0) : expectedSpinRate(m, invH);
    }
    return path;
}

Position originOf(const Motion& a, const Motion& b)
{
    return a.extent <= b.extent ? a.center : b.center;
}

SweptPair sweptPairOf(const Contact& contact, const ShapeTable& shapes, const Motion& a, const Motion& b,
                      real invH)
{
    const Position origin = originOf(a, b);
    return {shapes.rows[contact.shapeA].convex, shapes.rows[contact.shapeB].convex,
            predictedPath(a, origin, invH), predictedPath(b, origin, invH), contact.restGap};
}

void ExpectedPaths::begin(std::size_t rows, real end, real invH)
{
    ++span_;
    rows_.resize(rows);
    end_ = end;
    invH_ = invH;
}

const Trajectory& ExpectedPaths::pathOf(std::uint32_t row, const Motion& m)
{
    Row& known = rows_[row];
    if (known.span != span_) {
        known.span = span_;
        known.path = predictedPath(m, m.center, invH_);
        known.path.lookAhead(end_);
    }
    return known.path;
}

SweptPair ExpectedPaths::pairOf(const Contact& contact, const ShapeTable& shapes, const MotionTable& motions)
{
    const Motion &a = motions.rows[contact.rowA], &b = motions.rows[contact.rowB];
    const Position origin = originOf(a, b);
    SweptPair pair{shapes.rows[contact.shapeA].convex, shapes.rows[contact.shapeB].convex,
                   pathOf(contact.rowA, a), pathOf(contact.rowB, b), contact.restGap};
    pair.pathA.position = toVec2(a.center - origin);
    pair.pathB.position = toVec2(b.center - origin);
    return pair;
}

void adoptManifold(Contact& contact, const SweptResult& result, real matchDistance)
{
    struct Known {
        std::uint32_t feature;
        Vec2 localB;
        real normalImpulse, tangentImpulse, stepNormal, stepTangent;
    } old[2];
    for (int k = 0; k < 2; ++k) {
        const ContactPointRow& p = contact.points[k];
        old[k] = {p.anchor.feature, p.anchor.localB, p.normalImpulse,
                  p.tangentImpulse, p.stepNormal,    p.stepTangent};
    }
    bool taken[2] = {contact.count < 1, contact.count < 2};
    const int count = result.near ? result.manifold.count : 0;
    bool found[2] = {false, false};

    contact.count = count;
    contact.normal = result.manifold.normal;
    contact.time = result.manifold.time;
    contact.atImpact = result.manifold.atImpact;
    for (int i = 0; i < count; ++i) {
        contact.points[i] = {};
        contact.points[i].anchor = result.manifold.points[i];
    }

    const auto carry = [&](int to, int from) {
        contact.points[to].normalImpulse = old[from].normalImpulse;
        contact.points[to].tangentImpulse = old[from].tangentImpulse;
        contact.points[to].stepNormal = old[from].stepNormal;
        contact.points[to].stepTangent = old[from].stepTangent;
        taken[from] = found[to] = true;
    };
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < 2; ++k)
            if (!found[i] && !taken[k] && old[k].feature == contact.points[i].anchor.feature) carry(i, k);
    for (int i = 0; i < count; ++i) {
        if (found[i]) continue;
        int nearest = -1;
        real least = matchDistance;
        for (int k = 0; k < 2; ++k) {
            const real distance = length(old[k].localB - contact.points[i].anchor.localB);
            if (!taken[k] && distance < least) least = distance, nearest = k;
        }
        if (nearest >= 0) carry(i, nearest);
    }
    if (!found[0] && !found[1]) contact.rollingImpulse = 0;
}

namespace {

// Could the two come near each other within the step if something deflected them?
bool withinReach(const SweptPair& pair, real gap, real dt)
{
    const Trajectory &a = pair.pathA, &b = pair.pathB;
    const real speed = length(a.velocity) + length(b.velocity) + absolute(a.spin) * pair.a.extent +
                       absolute(b.spin) * pair.b.extent;
    const real reach = speed * dt + length(a.acceleration - b.acceleration) * dt * dt;
    return gap <= reach + 3 * pair.restGap;
}

}  // namespace

void updateForStep(Contact& contact, const ShapeTable& shapes, const MotionTable& motions,
                   const StepContext& context, ExpectedPaths& paths, ClampCounts& clamps)
{
    const SweptPair pair = paths.pairOf(contact, shapes, motions);
    const real dt = static_cast<real>(context.dt);
    const SweptResult result = collideSwept(pair, 0, dt);

    clamps.advancement += result.exhausted ? 1 : 0;
    adoptManifold(contact, result, real(0.3) * maximum(pair.a.size, pair.b.size));
    const bool inactive = contact.count == 0;
    contact.swept = contact.atImpact || result.bends || (inactive && withinReach(pair, result.startGap, dt));
    contact.clearance = result.startGap;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
