// SPDX-License-Identifier: MIT
#include "contacts/update.hpp"

#include "base/room.hpp"
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
    kernels_ = &pairKernels(suitedLanes(asked_, rows));
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
        Room<PairOnWay, kMostPairLanes> pairs;
        Room<SweptResult*, kMostPairLanes> results;
        int count = 0;
    } waitingOf[kLaneKinds];
    const auto together = [&](int kind) {
        Waiting& w = waitingOf[kind];
        const std::uint32_t decided =
            kernels_->collide(static_cast<LaneKind>(kind), w.pairs.data(), w.count, w.results.data());
        for (int k = 0; k < w.count; ++k)
            if ((decided >> k & 1u) == 0) alone(static_cast<std::size_t>(w.results[k] - results));
        w.count = 0;
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
        waiting.results[waiting.count] = results + i;
        if (++waiting.count == kernels_->lanes) together(static_cast<int>(kind));
    }
    // Lanes that stand nearly empty are slower than one pair after the other.
    for (int kind = 0; kind < kLaneKinds; ++kind) {
        const Waiting& w = waitingOf[kind];
        if (w.count > 2) together(kind);
        for (int k = 0; k < w.count; ++k) alone(static_cast<std::size_t>(w.results[k] - results));
    }
}

namespace {

// The point with another anchor: what it carries stays, what was prepared of it does not.
ContactPointRow pointWith(const ManifoldPoint& anchor, const ContactPointRow& from)
{
    ContactPointRow point;
    point.anchor = anchor;
    point.normalImpulse = from.normalImpulse;
    point.tangentImpulse = from.tangentImpulse;
    point.stepNormal = from.stepNormal;
    point.stepTangent = from.stepTangent;
    return point;
}

bool hasFeaturesOf(const Contact& contact, const Manifold& manifold, int count)
{
    if (contact.count != count) return false;
    for (int i = 0; i < count; ++i)
        if (contact.points[i].anchor.feature != manifold.points[i].feature) return false;
    return true;
}

// Which of the points that were there goes on as the i-th of the manifold; none for those that are new.
void matchPoints(const Contact& contact, const Manifold& manifold, int count, real matchDistance,
                 const ContactPointRow* (&from)[2])
{
    bool taken[2] = {contact.count < 1, contact.count < 2};
    const auto take = [&](int i, int k) {
        from[i] = &contact.points[k];
        taken[k] = true;
    };
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < 2; ++k)
            if (from[i] == nullptr && !taken[k] &&
                contact.points[k].anchor.feature == manifold.points[i].feature)
                take(i, k);
    for (int i = 0; i < count; ++i) {
        if (from[i] != nullptr) continue;
        int nearest = -1;
        real least = matchDistance;
        for (int k = 0; k < 2; ++k) {
            const real distance = length(contact.points[k].anchor.localB - manifold.points[i].localB);
            if (!taken[k] && distance < least) least = distance, nearest = k;
        }
        if (nearest >= 0) take(i, nearest);
    }
}

}  // namespace

void adoptManifold(Contact& contact, const SweptResult& result, real matchDistance)
{
    const Manifold& manifold = result.manifold;
    const int count = result.near ? manifold.count : 0;
    if (hasFeaturesOf(contact, manifold, count)) {  // mostly
        for (int i = 0; i < count; ++i) contact.points[i] = pointWith(manifold.points[i], contact.points[i]);
        if (count == 0) contact.rollingImpulse = 0;
    } else {
        const ContactPointRow* from[2] = {nullptr, nullptr};
        matchPoints(contact, manifold, count, matchDistance, from);
        if (from[0] == nullptr && from[1] == nullptr) contact.rollingImpulse = 0;
        const ContactPointRow none,
            old[2] = {from[0] != nullptr ? *from[0] : none, from[1] != nullptr ? *from[1] : none};
        for (int i = 0; i < count; ++i) contact.points[i] = pointWith(manifold.points[i], old[i]);
        contact.count = count;
    }
    contact.normal = manifold.normal;
    contact.time = manifold.time;
    contact.atImpact = manifold.atImpact;
}

bool withinReach(const ShapeOnWay& a, const ShapeOnWay& b, real restGap, real gap, real dt)
{
    const real speed = length(a.path.velocity) + length(b.path.velocity) +
                       absolute(a.path.spin) * a.shape.extent + absolute(b.path.spin) * b.shape.extent;
    const real reach = speed * dt + length(a.path.acceleration - b.path.acceleration) * dt * dt;
    return gap <= reach + 3 * restGap;
}

bool mayMeet(const SweptPair& pair, real from, real to, const StepContext& context)
{
    const SweptResult result = collideSwept(pair, from, to);
    if (result.near && result.manifold.count > 0) return true;
    return result.startGap <= kSlowInCrowd * pair.restGap * static_cast<real>(context.ticks) &&
           withinReach({pair.a, pair.pathA}, {pair.b, pair.pathB}, pair.restGap, result.startGap, to - from);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
