// SPDX-License-Identifier: MIT
#include "contacts/update.hpp"

#include "contacts/rows.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

Vec2 expectedAcceleration(const Motion& m, real invH)
{
    return {expectedRate(m.acceleration.x, m.damping, m.velocity.x, m.steady.x, invH),
            expectedRate(m.acceleration.y, m.damping, m.velocity.y, m.steady.y, invH)};
}

real expectedSpinRate(const Motion& m, real invH)
{
    return expectedRate(m.spinRate, m.spinDamping, m.spin, m.steadySpin, invH);
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
    return {shapes.convex(contact.shapeA), shapes.convex(contact.shapeB), predictedPath(a, origin, invH),
            predictedPath(b, origin, invH), contact.restGap};
}

Aabb restingBounds(const BodyRow& body, const Convex& shape, real restGap)
{
    Trajectory path;
    path.angle = body.angle;
    path.rotation = body.rotation;
    return sweptBounds(shape, path, body.center, 0, 0, 3 * restGap * shape.size);
}

void ExpectedPaths::begin(std::size_t rows, real end, real invH)
{
    ++number_;
    rows_.resize(rows);
    wanted_.clear();
    end_ = end;
    invH_ = invH;
}

const Trajectory& ExpectedPaths::reckon(std::size_t row, const Motion& m, bool turns)
{
    Row& known = rows_[row];
    known.number = number_;
    known.turns = turns;
    known.path = predictedPath(m, m.center, invH_);
    if (turns) known.path.lookAhead(end_);
    known.span = SpanOfWay(known.path, end_);
    return known.path;
}

void ExpectedPaths::want(std::uint32_t row, bool turns)
{
    Row& known = rows_[row];
    if (known.number != number_) {
        known.number = number_;
        known.turns = false;
        wanted_.push_back(row);
    }
    known.turns = known.turns || turns;
}

void ExpectedPaths::want(const Contact& contact, const ShapeTable& shapes)
{
    want(contact.rowA, !shapes.convex(contact.shapeA).isDisc());
    want(contact.rowB, !shapes.convex(contact.shapeB).isDisc());
}

void ExpectedPaths::reckonWanted(const MotionTable& motions, Parallel& parallel)
{
    constexpr std::size_t kGrain = 64;
    parallel.forEach(wanted_.size(), kGrain, [&](const Chunk& chunk) {
        for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
            const std::uint32_t row = wanted_[k];
            reckon(row, motions.rows[row], rows_[row].turns);
        }
    });
    wanted_.clear();
}

namespace {

// Never -0, which would be +0 after a time of 0 on the way: lanes leave that sum out.
Vec2 seenFrom(Position origin, const Motion& m)
{
    return toVec2(m.center - origin) + Vec2{0, 0};
}

}  // namespace

SweptPair ExpectedPaths::pairOf(const Contact& contact, const ShapeTable& shapes,
                                const MotionTable& motions) const
{
    const Motion &a = motions.rows[contact.rowA], &b = motions.rows[contact.rowB];
    const Position origin = originOf(a, b);
    const Convex &shapeA = shapes.convex(contact.shapeA), &shapeB = shapes.convex(contact.shapeB);
    SweptPair pair{shapeA, shapeB, rows_[contact.rowA].path, rows_[contact.rowB].path, contact.restGap};
    pair.pathA.position = seenFrom(origin, a);
    pair.pathB.position = seenFrom(origin, b);
    return pair;
}

PairOnWay ExpectedPaths::pairOnWayOf(const Contact& contact, const ShapeTable& shapes,
                                     const MotionTable& motions) const
{
    const Motion &a = motions.rows[contact.rowA], &b = motions.rows[contact.rowB];
    const Position origin = originOf(a, b);
    const Convex &shapeA = shapes.convex(contact.shapeA), &shapeB = shapes.convex(contact.shapeB);
    return {&shapeA,
            &shapeB,
            &rows_[contact.rowA].span,
            &rows_[contact.rowB].span,
            seenFrom(origin, a),
            seenFrom(origin, b),
            contact.restGap};
}

void ExpectedPaths::collide(std::span<Contact* const> contacts, const ShapeTable& shapes,
                            const MotionTable& motions, SweptResult* results) const
{
    const auto alone = [&](std::size_t i) {
        results[i] = collideSwept(pairOf(*contacts[i], shapes, motions), 0, end_);
    };
    // Pairs that wait for their lanes to fill, by kind.
    struct Waiting {
        PairOnWay pairs[kLanes];
        std::size_t places[kLanes];
        int count = 0;
    } waitingOf[kLaneKinds];
    const auto together = [&](int kind) {
        Waiting& waiting = waitingOf[kind];
        SweptResult found[kLanes];
        bool decided[kLanes];
        collideInLanes(static_cast<LaneKind>(kind), waiting.pairs, waiting.count, found, decided);
        for (int k = 0; k < waiting.count; ++k) {
            if (decided[k])
                results[waiting.places[k]] = found[k];
            else
                alone(waiting.places[k]);
        }
        waiting.count = 0;
    };
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const Contact& c = *contacts[i];
        const LaneKind kind = laneKindOf(shapes.convex(c.shapeA), shapes.convex(c.shapeB));
        if (kind == LaneKind::None) {
            alone(i);
            continue;
        }
        Waiting& waiting = waitingOf[static_cast<int>(kind)];
        waiting.pairs[waiting.count] = pairOnWayOf(c, shapes, motions);
        waiting.places[waiting.count] = i;
        if (++waiting.count == kLanes) together(static_cast<int>(kind));
    }
    // Lanes that stand half empty are slower than one pair after the other.
    for (int kind = 0; kind < kLaneKinds; ++kind) {
        const Waiting& waiting = waitingOf[kind];
        if (waiting.count > kLanes / 2) together(kind);
        for (int k = 0; k < waiting.count; ++k) alone(waiting.places[k]);
    }
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

bool withinReach(const SweptPair& pair, real gap, real dt)
{
    const Trajectory &a = pair.pathA, &b = pair.pathB;
    const real speed = length(a.velocity) + length(b.velocity) + absolute(a.spin) * pair.a.extent +
                       absolute(b.spin) * pair.b.extent;
    const real reach = speed * dt + length(a.acceleration - b.acceleration) * dt * dt;
    return gap <= reach + 3 * pair.restGap;
}

bool mayMeet(const SweptPair& pair, real from, real to, const StepContext& context)
{
    const SweptResult result = collideSwept(pair, from, to);
    if (result.near && result.manifold.count > 0) return true;
    return result.startGap <= kSlowInCrowd * pair.restGap * static_cast<real>(context.ticks) &&
           withinReach(pair, result.startGap, to - from);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
