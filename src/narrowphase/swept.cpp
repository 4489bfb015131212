// SPDX-License-Identifier: MIT
// Swept manifolds: which manifold stands for a pair over a whole step. Two ideas carry it. A face
// that separates the cores at both ends separates them all the way, so a body gliding over flush
// tiles never sees the side of the next one. And whatever is left is settled by conservative
// advancement, so nothing passes. Derivation: docs/theory/contacts.md, section 2.

#include "narrowphase/swept.hpp"

#include "narrowphase/disc_kernel.hpp"

#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {

void Trajectory::lookAhead(real t)
{
    ahead = at(t).q;
    aheadTime = t;
}

Pose Trajectory::at(real t) const
{
    if (t == aheadTime && t > 0) return {positionAt(t), ahead};
    const real turn = turnBy(t);
    return {positionAt(t), turn == 0 ? rotation : Rot::ofAngle(angle + static_cast<double>(turn))};
}

namespace {

// How a disc has turned makes no difference.
Pose poseAt(const Trajectory& path, const Convex& shape, real t)
{
    return shape.isDisc() ? Pose{path.positionAt(t), path.rotation} : path.at(t);
}

PlacedPair placedAt(const SweptPair& pair, real t)
{
    return {pair.a, poseAt(pair.pathA, pair.a, t), pair.b, poseAt(pair.pathB, pair.b, t)};
}

// All that the stages below share about one sweep.
struct Sweep {
    const SweptPair& pair;
    real from, to;
    PlacedPair atStart, atEnd;
    real radii;                // of rounding, both
    real admit;                // gaps up to here get a manifold
    real deep;                 // overlap from here on counts as one
    bool byFaces;              // two sharp polygons: separation by faces
    Separation start, end;     // gaps, radii subtracted; by faces: the distance alone
    Vec2 slide;                // relative displacement of the centers
    real turnA, turnB;         // [rad], absolute
    real travel;               // bound on the motion of any point of the one against the other
    real sagitta;              // how far a turning point leaves its chord
    bool turning;
    bool sharp;                // no rounding on either of two that have faces

    Sweep(const SweptPair& p, real t0, real t1)
        : pair(p), from(t0), to(t1), atStart(p.a, poseAt(p.pathA, p.a, t0), p.b, poseAt(p.pathB, p.b, t0)),
          atEnd(p.a, poseAt(p.pathA, p.a, t1), p.b, poseAt(p.pathB, p.b, t1)), radii(p.a.radius + p.b.radius),
          admit(3 * p.restGap), deep(-p.restGap / 2), byFaces(isSharpPair(p.a, p.b)), start(ofEnd(atStart)),
          end(ofEnd(atEnd)), slide((atEnd.poseB.p - atEnd.poseA.p) - (atStart.poseB.p - atStart.poseA.p)),
          turnA(absolute(p.pathA.turnBy(t1) - p.pathA.turnBy(t0))),
          turnB(absolute(p.pathB.turnBy(t1) - p.pathB.turnBy(t0))),
          travel(length(slide) + turnA * p.a.extent + turnB * p.b.extent),
          sagitta((p.a.faces() > 0 ? turnA * turnA / 8 * p.a.extent : 0) +
                  (p.b.faces() > 0 ? turnB * turnB / 8 * p.b.extent : 0)),
          turning(sagitta > p.restGap / 2), sharp(p.a.faces() > 0 && p.b.faces() > 0 && radii <= 0)
    {
    }

    // Faces that separate sharp polygons at both ends are likely to do so for longer. Of corners that touch,
    // rounding leaves no direction between them.
    Apart apart() const
    {
        const bool isExact = start.kind != Separation::Kind::Vertices ||
                             (pair.a.isDisc() && pair.b.isDisc()) ||
                             start.distance + radii > 8 * pair.restGap;
        if (!byFaces) return isExact ? Apart{start.normal, start.distance} : Apart{};
        Apart best;
        real widest = -std::numeric_limits<real>::max();
        const auto consider = [&](real atFirst, real atLast, Vec2 axis) {
            const real narrower = minimum(atFirst, atLast);
            if (narrower > widest) widest = narrower, best = {axis, atFirst};
        };
        const FacedCores &first = atStart.cores, &last = atEnd.cores;
        for (int i = 0; i < first.a.faces(); ++i) consider(first.fromA[i], last.fromA[i], first.a.normals[i]);
        for (int i = 0; i < first.b.faces(); ++i)
            consider(first.fromB[i], last.fromB[i], -first.b.normals[i]);
        return best;
    }

    // Against the size of the smaller.
    bool isSlow() const { return travel < real(0.25) * minimum(pair.a.extent, pair.b.extent); }
    // Those that all but touch and go for each other, slowly, do so with the features that are nearest now.
    bool presses() const { return start.distance <= admit && travel < kSlowest * pair.restGap && !turning; }
    real preference() const { return real(0.1) * pair.restGap; }

    real gap(const PlacedPair& placed) const { return coreDistance(placed) - radii; }
    Separation separation(const PlacedPair& placed) const
    {
        Separation s = coreSeparation(placed, 0);
        s.distance -= radii;
        return s;
    }
    Separation ofEnd(const PlacedPair& placed) const
    {
        return byFaces ? Separation{gap(placed), {}, Separation::Kind::FaceA, 0, 0} : separation(placed);
    }
    real gapAt(real t) const { return gap(placedAt(pair, t)); }
    // Of discs, which the search for impacts asks for most, without placing them.
    Separation separationAt(real t) const
    {
        if (!pair.a.isDisc() || !pair.b.isDisc()) return separation(placedAt(pair, t));
        const CenterLine<real> line(pair.pathB.positionAt(t) - pair.pathA.positionAt(t));
        return {line.distance - radii, line.normal, Separation::Kind::Vertices, 0, 0};
    }
    real timeAt(real part) const { return from + part * (to - from); }

    SweptResult closest(const PlacedPair& placed) const
    {
        return with([&](Manifold& m) { closestManifold(placed, preference(), m); });
    }
    // Of two that both have faces, a face of A is preferred; else the closest features are at hand.
    SweptResult closestAt(const PlacedPair& placed, const Separation& known) const
    {
        if (placed.a.faces() > 0 && placed.b.faces() > 0) return closest(placed);
        return with([&](Manifold& m) { closestManifold(placed, known, m); });
    }
    SweptResult closestAtStart() const { return closestAt(atStart, start); }
    SweptResult closestAtEnd() const { return closestAt(atEnd, end); }

    template <class Fill>
    SweptResult with(const Fill& fill) const
    {
        SweptResult result;
        fill(result.manifold);
        result.near = true;
        result.manifold.time = from;
        return result;
    }

    SweptResult impactAt(real t) const
    {
        SweptResult result = closest(placedAt(pair, t));
        result.manifold.time = t;
        result.manifold.atImpact = true;
        return result;
    }

    bool byFace(bool whichEnd, const FaceQuery& axis, bool force, SweptResult& result) const
    {
        result.near = faceManifold(whichEnd ? atEnd : atStart, axis.onA, axis.face, force, result.manifold);
        result.manifold.time = from;
        return result.near;
    }
};

// The face that separates best over the whole sweep: the greatest of min(start, end). Of faces that
// nearly tie, the one the motion runs along: its normal is the one that stays right as the other
// shape slides past.
struct SweptFace {
    FaceQuery axis;
    bool smallerAtEnd;
    real atStart;  // distance [m]
};

// By face of one core: its distance over the sweep, and what it is worth.
struct FaceScores {
    real least[kMaxPolygonVertices], score[kMaxPolygonVertices];  // only those of faces are ever written

    FaceScores(const Sweep& s, const PlacedCore& core, const FaceDistances& first, const FaceDistances& last)
    {
        const BasicVec2<Lanes> slide{s.slide.x, s.slide.y};
        const Lanes radii(s.radii), deep(s.deep), restGap(s.pair.restGap);
        for (int i = 0; i < core.faces(); i += kLanes) {
            const Lanes nearest = minimum(first.lanes(i), last.lanes(i)) - radii;
            storeLane(nearest, least + i);
            storeLane(faceScore(nearest, core.normals.lanes(i), slide, deep, restGap), score + i);
        }
    }
};

SweptFace bestFaceOverSweep(const Sweep& s)
{
    const FacedCores &first = s.atStart.cores, &last = s.atEnd.cores;
    const FaceScores fromA(s, first.a, first.fromA, last.fromA), fromB(s, first.b, first.fromB, last.fromB);
    FaceQuery best{-std::numeric_limits<real>::max(), true, 0};  // by score
    for (int i = 0; i < first.a.faces(); ++i)
        if (fromA.score[i] > best.distance) best = {fromA.score[i], true, i};
    for (int i = 0; i < first.b.faces(); ++i) {
        const bool handicap = best.onA && first.a.faces() > 0;
        if (fromB.score[i] > best.distance + (handicap ? s.preference() : real(0)))
            best = {fromB.score[i], false, i};
    }
    best.distance = (best.onA ? fromA : fromB).least[best.face];
    const real atStart = (best.onA ? first.fromA : first.fromB)[best.face];
    const real atEnd = (best.onA ? last.fromA : last.fromB)[best.face];
    return {best, atEnd <= atStart + s.preference(), atStart};
}

// A face keeps the two apart all the way: a support manifold, or nothing. Returns true if settled.
bool settledByFace(const Sweep& s, const SweptFace& best, SweptResult& result)
{
    if (best.axis.distance <= s.deep || s.turning) return false;
    if (best.axis.distance > s.admit) return true;
    if (s.byFace(best.smallerAtEnd, best.axis, false, result)) return true;
    if (s.byFace(!best.smallerAtEnd, best.axis, false, result)) return true;
    // Beyond the end of the face a sharp corner meets nothing; a rounded one may still touch the corner.
    return s.sharp;
}

// Sharp polygons that overlap at the start, or nearly and no worse later, or that press on each other.
bool settledByOverlap(const Sweep& s, const SweptFace& best, SweptResult& result)
{
    const real gap = s.start.distance;
    const bool grazing = gap < s.pair.restGap && best.axis.distance > 8 * s.deep && !s.turning;
    const bool overlaps = gap < s.deep || grazing;
    if (!overlaps && !s.presses()) return false;
    if (s.sagitta >= s.pair.restGap || best.atStart < gap - kThrough * s.pair.restGap) {
        result = s.closestAtStart();
        return true;
    }
    s.byFace(best.smallerAtEnd && overlaps && s.isSlow(), best.axis, true, result);
    return true;
}

// Rounded shapes: the distance to a convex set along a line is convex, so its least value is at an
// end unless the motion turns from approach to departure in between.
bool settledByConvexity(const Sweep& s, SweptResult& result)
{
    const real first = s.start.distance, last = s.end.distance;
    if (first < s.deep) {
        result = last < first && last > 8 * s.deep ? s.closestAtEnd() : s.closestAtStart();
        return true;
    }
    if (s.turning) return false;
    const bool apartAtEnd = last > s.deep;
    if (apartAtEnd && dot(s.start.normal, s.slide) >= 0) {
        if (first <= s.admit) result = s.closestAtStart();
        return true;
    }
    if (apartAtEnd && dot(s.end.normal, s.slide) <= 0) {
        if (last <= s.admit) result = s.closestAtEnd();
        return true;
    }
    if (!s.presses()) return false;
    result = s.closestAtStart();
    return true;
}

// Does any point near contact close at the start, turning included?
bool closesAtStart(const Sweep& s, const Manifold& manifold)
{
    const Trajectory &pathA = s.pair.pathA, &pathB = s.pair.pathB;
    const Vec2 vA = pathA.velocity + s.from * pathA.acceleration;
    const Vec2 vB = pathB.velocity + s.from * pathB.acceleration;
    const real spinA = pathA.spin + s.from * pathA.spinRate, spinB = pathB.spin + s.from * pathB.spinRate;
    for (int i = 0; i < manifold.count; ++i) {
        const Vec2 rA = rotate(s.atStart.poseA.q, manifold.points[i].localA);
        const Vec2 rB = rotate(s.atStart.poseB.q, manifold.points[i].localB);
        const real gap = dot(manifold.normal, (s.atStart.poseB.p + rB) - (s.atStart.poseA.p + rA)) - s.radii;
        const Vec2 v = vB + cross(spinB, rB) - vA - cross(spinA, rA);
        const real slow = real(1e-3) * s.travel / (s.to - s.from);
        if (gap < real(1.5) * s.pair.restGap && dot(manifold.normal, v) < -slow) return true;
    }
    return false;
}

// On from a part of the way in steps of about 0.1 rad to where a corner digs in, and bisected for the
// moment just before.
SweptResult marchFrom(const Sweep& s, real start, const SweptResult& otherwise)
{
    const real turns = minimum(real(62), (s.turnA + s.turnB) / real(0.1));
    const int marches = static_cast<int>(turns) + 2;
    real clear = start;
    for (int k = 1; k <= marches; ++k) {
        const real part = start + (1 - start) * static_cast<real>(k) / static_cast<real>(marches);
        if (s.gapAt(s.timeAt(part)) >= s.deep) {
            clear = part;
            continue;
        }
        real digs = part;
        for (int b = 0; b < 10; ++b) {
            const real middle = (clear + digs) / 2;
            (s.gapAt(s.timeAt(middle)) < s.deep ? digs : clear) = middle;
        }
        return s.impactAt(s.timeAt(clear));
    }
    return otherwise;
}

// Polygons that touch at the start and turn: if nothing closes there, on to the next corner.
SweptResult marchTurning(const Sweep& s)
{
    SweptResult result = s.closestAtStart();
    result.manifold.atImpact = true;
    if (closesAtStart(s, result.manifold)) return result;
    return marchFrom(s, 0, result);
}

// Conservative advancement [Mirtich 1996]: never step further than the gap allows at the fastest
// rate at which it could close.
SweptResult advance(const Sweep& s)
{
    constexpr int kMaxIterations = 64;
    const bool polygons = s.pair.a.faces() > 0 && s.pair.b.faces() > 0;
    const real target = s.pair.restGap / 4;
    const real spinTravel = s.turnA * s.pair.a.extent + s.turnB * s.pair.b.extent;

    real part = 0, nearestPart = 0;
    Separation now = s.byFaces ? s.separation(s.atStart) : s.start;
    real nearest = now.distance;
    bool hit = false, exhausted = false;
    for (int iteration = 0;; ++iteration) {
        if (now.distance <= target) {
            hit = true;
            break;
        }
        if (part >= 1) break;
        if (iteration == kMaxIterations) {
            // Close and fast past each other: what is left of the way in bigger steps.
            if (s.turning && polygons) return marchFrom(s, part, {});
            hit = exhausted = true;  // the safe side
            break;
        }
        if (!s.turning && !polygons && dot(now.normal, s.slide) >= spinTravel) break;  // moving away
        real rate = s.travel;
        if (!s.turning && s.sharp) {
            const real closing = spinTravel - dot(now.normal, s.slide);
            if (closing > 0) rate = closing;
        }
        part = minimum(real(1), part + maximum(now.distance - target / 2, target / 2) / rate);
        now = s.separationAt(s.timeAt(part));
        if (now.distance < nearest) {
            nearest = now.distance;
            nearestPart = part;
        }
    }

    if (!hit) {
        if (nearest > s.admit) return {};
        const real t = s.timeAt(nearestPart);
        if (s.sharp) {
            SweptResult result;
            const PlacedPair placed = placedAt(s.pair, t);
            const FaceQuery axis = bestFace(placed.cores, s.preference());
            result.near = faceManifold(placed, axis.onA, axis.face, false, result.manifold);
            result.manifold.time = t;
            return result;
        }
        part = nearestPart;
    }
    // A round shape that only skims takes the manifold of the nearer end: at a seam that is the face
    // and not the corner.
    const bool skims = !polygons && !s.turning && minimum(s.start.distance, s.end.distance) > s.deep &&
                       s.end.distance < minimum(s.start.distance, s.admit) &&
                       dot(s.end.normal, s.slide) < real(0.05) * length(s.slide);
    SweptResult result = s.impactAt(s.timeAt(part));
    if (skims) {
        const real time = result.manifold.time;
        result = s.closestAtEnd();
        result.manifold.time = time;
        result.manifold.atImpact = true;
    }
    result.exhausted = exhausted;
    return result;
}

// Gap that the manifold shows at given poses: of its planes, where the true one is of the surfaces.
real shownGap(const Sweep& s, const Manifold& manifold, const Pose& poseA, const Pose& poseB)
{
    const BasicPose<real> a{poseA.p, poseA.q.c, poseA.q.s}, b{poseB.p, poseB.q.c, poseB.q.s};
    real least = std::numeric_limits<real>::max();
    for (int i = 0; i < manifold.count; ++i) {
        const ManifoldPoint& p = manifold.points[i];
        least = minimum(least, distanceAlong(manifold.normal, a, p.localA, b, p.localB) - s.radii);
    }
    return least;
}

// A manifold has one normal for all the sweep. Does the true surface leave that plane, towards the
// other body, by more than counts as overlap? As a corner runs on its arc, as a face turns under what
// slides along it, or as one rounding slides about another.
bool bendsAway(const Sweep& s, const Manifold& manifold)
{
    if (s.turning) return true;
    const auto hides = [&](real gap, const Pose& poseA, const Pose& poseB) {
        return gap < s.admit && shownGap(s, manifold, poseA, poseB) > gap - s.deep;
    };
    if (hides(s.start.distance, s.atStart.poseA, s.atStart.poseB) ||
        hides(s.end.distance, s.atEnd.poseA, s.atEnd.poseB))
        return true;

    // Halfway a turning face is off the line between its ends by a fourth of turn times slide.
    const real along = absolute(cross(manifold.normal, s.slide));
    const real turn = (s.pair.a.faces() > 0 ? s.turnA : 0) + (s.pair.b.faces() > 0 ? s.turnB : 0);
    if (along * turn / 4 <= -s.deep) return false;
    const real middle = s.timeAt(real(0.5));
    const PlacedPair halfway = placedAt(s.pair, middle);
    return hides(s.gap(halfway), halfway.poseA, halfway.poseB);
}

SweptResult settle(const Sweep& s)
{
    SweptResult result;
    const bool polygons = s.pair.a.faces() > 0 && s.pair.b.faces() > 0;
    if (s.pair.a.faces() + s.pair.b.faces() > 0) {
        const SweptFace best = bestFaceOverSweep(s);
        if (settledByFace(s, best, result)) return result;
        if (s.sharp && settledByOverlap(s, best, result)) return result;
    }
    if (!s.sharp && settledByConvexity(s, result)) return result;
    if (s.turning && polygons && s.start.distance <= real(1.5) * s.pair.restGap) return marchTurning(s);
    return advance(s);
}

}  // namespace

SweptResult collideSwept(const SweptPair& pair, real from, real to)
{
    const Sweep s(pair, from, to);
    // A gap can change no faster than the two move.
    SweptResult result;
    if ((s.start.distance + s.end.distance - s.travel) / 2 <= s.admit) result = settle(s);
    result.startGap = s.start.distance;
    result.apart = s.apart();
    result.bends = result.near && bendsAway(s, result.manifold);
    return result;
}

SweptResult nearestAt(const SweptPair& pair, real t)
{
    const PlacedPair placed = placedAt(pair, t);
    SweptResult result;
    result.startGap = coreDistance(placed) - pair.a.radius - pair.b.radius;
    result.near = result.startGap <= 3 * pair.restGap;
    if (result.near) closestManifold(placed, real(0.1) * pair.restGap, result.manifold);
    return result;
}

Aabb sweptBounds(const Convex& shape, const Trajectory& path, Position origin, real from, real to,
                 real margin)
{
    // The chord between two poses holds all but the sagitta of the turn and of the parabola.
    const real span = to - from;
    const real turn = absolute(path.turnBy(to) - path.turnBy(from));
    const real bulge = length(path.acceleration) * span * span / 8 + margin;
    const Vec2 ends[2] = {path.positionAt(from), path.positionAt(to)};
    Vec2 lower = ends[0], upper = ends[0];
    const auto include = [&](Vec2 p) {
        lower = {minimum(lower.x, p.x), minimum(lower.y, p.y)};
        upper = {maximum(upper.x, p.x), maximum(upper.y, p.y)};
    };
    real grow = bulge + shape.radius;
    if (turn > real(0.5)) {
        include(ends[1]);
        grow = bulge + shape.extent;
    } else {
        lower = {std::numeric_limits<real>::max(), std::numeric_limits<real>::max()};
        upper = -lower;
        for (const real t : {from, to}) {
            const Pose pose = path.at(t);
            for (int i = 0; i < shape.count; ++i) include(pose.p + rotate(pose.q, shape.vertices[i]));
        }
        grow += turn * turn / 8 * shape.extent;
    }
    const DVec2 by{static_cast<double>(grow), static_cast<double>(grow)};
    return {origin + toDVec2(lower) - by, origin + toDVec2(upper) + by};
}

real gapAt(const SweptPair& pair, real t)
{
    return coreDistance(placedAt(pair, t)) - pair.a.radius - pair.b.radius;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
