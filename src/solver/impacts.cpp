// SPDX-License-Identifier: MIT
// Impulses at their time of impact. Every contact is looked at once per sweep, on clocks of the
// bodies' own, until no impact is left in the tick. A body hit at time t keeps its impulse as two
// kicks, before and after the drift, so that it ends up where a body hit at t would be: no position
// is ever corrected. docs/theory/contacts.md, section 3.

#include "solver/impacts.hpp"

#include "contacts/rows.hpp"
#include "contacts/update.hpp"

#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr real kNever = std::numeric_limits<real>::max();

// A body on its way through the tick. Its place is that of the tick's start plus
// offset + velocity t + acceleration t^2/2: an impact at t shifts the offset by -t dv.
struct Flight {
    Vec2 offset;
    real turned = 0;
    Vec2 velocity;
    real spin = 0;
    Vec2 acceleration;
    real spinRate = 0;
    real clock = 0;          // of its last impact
    bool hit = false;        // in this sweep
    bool hitBefore = false;  // in the sweep before
};

// What the search for impacts needs to know of one point, at the start of the tick.
struct ImpactPoint {
    Vec2 armA, armB;
    real gap = 0;
};

struct Impact {
    real time = kNever;
};

// Two bodies and a point between them at one moment.
struct Moment {
    Vec2 normal;
    PlacedPoint place;
    Vec2 velocityA, velocityB;
    real spinA, spinB;
    Vec2 relative() const
    {
        return velocityB + cross(spinB, place.armB) - velocityA - cross(spinA, place.armA);
    }
};

class ImpactSolver {
public:
    ImpactSolver(ImpactStage& stage, const StepContext& context, int tick);
    void run();

private:
    ImpactStage& stage_;
    const StepContext& context_;
    const real tickStart_;               // within the step   [s]
    std::vector<Flight> flights_;        // by row
    std::vector<ImpactPoint> points_;    // two for each contact

    Contact& contact(std::size_t i) { return stage_.contacts.rows[i]; }
    Motion& motion(std::uint32_t row) { return stage_.motions.rows[row]; }

    void placePoints(std::size_t i);
    Impact nextImpact(std::size_t i, int point);
    Moment momentAt(const Contact& c, const ManifoldPoint& anchor, real t);
    real refined(const Contact& c, const ManifoldPoint& anchor, real t, real earliest);
    bool process(std::size_t i);
    bool processBoth(Contact& c, int first, real t, real restitution);
    void processOne(Contact& c, int point, const Moment& moment, real t, real restitution);
    real frictionImpulse(Contact& c, const Moment& moment, real normalImpulse, real t);
    void applyAt(const Contact& c, const PlacedPoint& place, Vec2 impulse, real t);
    void record(Contact& c, const Moment& before, real normalImpulse, real tangentImpulse, real t,
                real restitution);
    SweptPair sweptPair(const Contact& c);
    bool turnsOn(const Contact& c, real rest);
    void resweep(std::size_t i, bool own);
    void pairAgain(std::uint32_t row);
};

ImpactSolver::ImpactSolver(ImpactStage& stage, const StepContext& context, int tick)
    : stage_(stage), context_(context), tickStart_(static_cast<real>(tick) * context.h),
      flights_(stage.motions.rows.size()), points_(2 * stage.contacts.rows.size())
{
    for (std::size_t i = 0; i < flights_.size(); ++i) {
        const Motion& m = stage.motions.rows[i];
        flights_[i].velocity = m.velocity;
        flights_[i].spin = m.spin;
        if (!m.moves()) continue;
        flights_[i].acceleration = expectedAcceleration(m, context.invH);
        flights_[i].spinRate = expectedSpinRate(m, context.invH);
    }
    for (std::size_t i = 0; i < stage.contacts.rows.size(); ++i) {
        contact(i).impacts = 0;
        placePoints(i);
    }
}

// Bodies and point at time t of the tick, turned as they are then.
Moment ImpactSolver::momentAt(const Contact& c, const ManifoldPoint& anchor, real t)
{
    const Motion &a = motion(c.rowA), &b = motion(c.rowB);
    const Flight &fa = flights_[c.rowA], &fb = flights_[c.rowB];
    const auto rotationOf = [t](const Motion& m, const Flight& f) {
        const real turn = f.turned + t * f.spin + t * t / 2 * f.spinRate;
        return turn == 0 ? m.rotation : Rot::ofAngle(m.angle + static_cast<double>(turn));
    };
    const auto shiftOf = [t](const Flight& f) {
        return f.offset + t * f.velocity + (t * t / 2) * f.acceleration;
    };

    Moment moment;
    const Vec2 d = toVec2(b.center - a.center) + shiftOf(fb) - shiftOf(fa);
    const Rot qA = rotationOf(a, fa), qB = rotationOf(b, fb);
    moment.normal = c.normal;
    if (anchor.roundOnRound) {
        const Vec2 between = d + rotate(qB, anchor.localB) - rotate(qA, anchor.localA);
        const real distance = length(between);
        if (distance > 0) moment.normal = (1 / distance) * between;
    }
    moment.place = placePoint(c, moment.normal, anchor, qA, qB, d);
    moment.velocityA = fa.velocity + t * fa.acceleration;
    moment.velocityB = fb.velocity + t * fb.acceleration;
    moment.spinA = fa.spin + t * fa.spinRate;
    moment.spinB = fb.spin + t * fb.spinRate;
    return moment;
}

// Gap and arms of each point of a contact, for the search. The manifold of an impact is linearized
// about its own pose: a fast spinner has turned far from the start of the tick by then.
void ImpactSolver::placePoints(std::size_t i)
{
    const Contact& c = contact(i);
    for (int k = 0; k < c.count; ++k) {
        ImpactPoint& point = points_[2 * i + static_cast<std::size_t>(k)];
        if (!c.atImpact) {
            point = {c.points[k].armA, c.points[k].armB, c.points[k].gap};
            continue;
        }
        const Moment at = momentAt(c, c.points[k].anchor, c.time);
        const Flight &fa = flights_[c.rowA], &fb = flights_[c.rowB];
        const real t = c.time;
        const auto shiftOf = [t](const Flight& f) {
            return f.offset + t * f.velocity + (t * t / 2) * f.acceleration;
        };
        const auto turnOf = [t](const Flight& f) { return f.turned + t * f.spin + t * t / 2 * f.spinRate; };
        point.armA = at.place.armA;
        point.armB = at.place.armB;
        point.gap = at.place.gap - dot(c.normal, shiftOf(fb) - shiftOf(fa)) -
                    cross(point.armB, c.normal) * turnOf(fb) + cross(point.armA, c.normal) * turnOf(fa);
    }
}

// When the point's gap first reaches zero while closing faster than steady forces could make it.
Impact ImpactSolver::nextImpact(std::size_t i, int k)
{
    const Contact& c = contact(i);
    if (k >= c.count || c.impacts >= context_.tuning.impactsPerContact || !(c.points[k].normalMass > 0))
        return {};
    const ImpactPoint& point = points_[2 * i + static_cast<std::size_t>(k)];
    const Motion &a = motion(c.rowA), &b = motion(c.rowB);
    const Flight &fa = flights_[c.rowA], &fb = flights_[c.rowB];
    const Vec2 n = c.normal;
    const real turnA = cross(point.armA, n), turnB = cross(point.armB, n);

    const real offset = dot(n, fb.offset - fa.offset) + turnB * fb.turned - turnA * fa.turned;
    const real speed = dot(n, fb.velocity - fa.velocity) + turnB * fb.spin - turnA * fa.spin;
    const real push = dot(n, fb.acceleration - fa.acceleration) + turnB * fb.spinRate - turnA * fa.spinRate;

    // Anchors of a turning body run on circles: counts for the time, not for the speed.
    real bend = push;
    const bool turns = (absolute(fa.spin) + absolute(fb.spin)) * context_.h >= real(0.05);
    if (turns && !c.atImpact) {
        const Vec2 coreA = rotate(a.rotation, c.points[k].anchor.localA);
        const Vec2 coreB = rotate(b.rotation, c.points[k].anchor.localB);
        bend += fa.spin * fa.spin * dot(n, coreA) - fb.spin * fb.spin * dot(n, coreB);
    }

    const real start = maximum(fa.clock, fb.clock);
    const real gap = point.gap + offset + speed * start + bend * start * start / 2;
    const real closing = speed + bend * start;
    real t = start;
    if (gap > 0) {
        const real discriminant = closing * closing - 2 * bend * gap;
        if (discriminant < 0) return {};
        const real root = std::sqrt(discriminant);
        real wait;
        if (closing < 0)
            wait = 2 * gap / (root - closing);
        else if (bend < 0)
            wait = (-closing - root) / bend;
        else
            return {};
        t = start + wait;
        if (!(t <= context_.h)) return {};
    }
    const real approach = speed + push * t;
    if (!(approach < -impactThreshold(c, a, b, context_)) || approach >= 0) return {};
    return {t};
}

// The time at which the true gap of the turning bodies closes, by Newton's method.
real ImpactSolver::refined(const Contact& c, const ManifoldPoint& anchor, real t, real earliest)
{
    for (int i = 0; i < 3; ++i) {
        const Moment moment = momentAt(c, anchor, t);
        const real speed = dot(moment.normal, moment.relative());
        if (absolute(moment.place.gap) < real(0.001) * c.restGap || !(speed < 0)) break;
        t = clamp(t - moment.place.gap / speed, earliest, context_.h);
    }
    return t;
}

void ImpactSolver::applyAt(const Contact& c, const PlacedPoint& place, Vec2 impulse, real t)
{
    const real late = t * context_.invH, early = 1 - late;
    const auto hit = [&](std::uint32_t row, Vec2 arm, Vec2 given) {
        const Motion& m = motion(row);
        if (!m.moves()) return;
        Flight& f = flights_[row];
        ImpactKick& kick = stage_.kicks[row];
        const Vec2 dv{m.invMass.x * given.x, m.invMass.y * given.y};
        const real dw = m.invInertia * cross(arm, given);
        f.velocity += dv;
        f.spin += dw;
        f.offset -= t * dv;
        f.turned -= t * dw;
        kick.before += early * dv;
        kick.after += late * dv;
        kick.spinBefore += early * dw;
        kick.spinAfter += late * dw;
        f.clock = t;
        f.hit = true;
    };
    hit(c.rowA, place.armA, -impulse);
    hit(c.rowB, place.armB, impulse);
}

// Friction acts on the slip that the normal impulse leaves: the other order raises energy [ADR16].
real ImpactSolver::frictionImpulse(Contact& c, const Moment& moment, real normalImpulse, real t)
{
    if (!(c.friction > 0)) return 0;
    const Vec2 tangent = perpendicular(moment.normal);
    const real mass = compliance(motion(c.rowA), moment.place.armA, tangent) +
                      compliance(motion(c.rowB), moment.place.armB, tangent);
    if (!(mass > 0)) return 0;
    const Flight &fa = flights_[c.rowA], &fb = flights_[c.rowB];
    const Vec2 vA = fa.velocity + t * fa.acceleration, vB = fb.velocity + t * fb.acceleration;
    const real wA = fa.spin + t * fa.spinRate, wB = fb.spin + t * fb.spinRate;
    const real slip =
        dot(tangent, vB + cross(wB, moment.place.armB) - vA - cross(wA, moment.place.armA)) + c.surfaceSpeed;
    const real impulse = clamp(-slip / mass, -c.friction * normalImpulse, c.friction * normalImpulse);
    applyAt(c, moment.place, impulse * tangent, t);
    return impulse;
}

void ImpactSolver::record(Contact& c, const Moment& before, real normalImpulse, real tangentImpulse, real t,
                          real restitution)
{
    const Flight& fa = flights_[c.rowA];
    const Motion& a = motion(c.rowA);
    ImpactRecord entry;
    entry.shapeA = c.shapeA;
    entry.shapeB = c.shapeB;
    HitEvent& hit = entry.hit;
    hit.time = context_.time + static_cast<double>(tickStart_) + static_cast<double>(t);
    const Vec2 shift = fa.offset + t * fa.velocity + (t * t / 2) * fa.acceleration;
    hit.point = a.center + toDVec2(shift) + toDVec2(before.place.armA);
    hit.normal = before.normal;
    hit.armA = before.place.armA;
    hit.armB = before.place.armB;
    hit.approachSpeed = -dot(before.normal, before.relative());
    hit.restitution = restitution;
    hit.normalImpulse = normalImpulse;
    hit.tangentImpulse = tangentImpulse;
    hit.velocityA = before.velocityA;
    hit.velocityB = before.velocityB;
    hit.angularVelocityA = before.spinA;
    hit.angularVelocityB = before.spinB;
    hit.group = stage_.groups;
    c.stepImpulse += normalImpulse * before.normal + tangentImpulse * perpendicular(before.normal);
    stage_.records.push_back(entry);
}

// DD8 at one point, then Coulomb.
void ImpactSolver::processOne(Contact& c, int k, const Moment& moment, real t, real restitution)
{
    const real mass = compliance(motion(c.rowA), moment.place.armA, moment.normal) +
                      compliance(motion(c.rowB), moment.place.armB, moment.normal);
    const real impulse = -(1 + restitution) * dot(moment.normal, moment.relative()) / mass;
    applyAt(c, moment.place, impulse * moment.normal, t);
    const real friction = frictionImpulse(c, moment, impulse, t);
    c.points[k].stepNormal += impulse;
    c.points[k].stepTangent += friction;
    record(c, moment, impulse, friction, t, restitution);
}

// Two points that close at once: both normal speeds are reversed together, which keeps the energy
// of an elastic flat landing. False if only one of them takes part.
bool ImpactSolver::processBoth(Contact& c, int first, real t, real restitution)
{
    const int second = 1 - first;
    const Moment one = momentAt(c, c.points[first].anchor, t), two = momentAt(c, c.points[second].anchor, t);
    const real v1 = dot(c.normal, one.relative()), v2 = dot(c.normal, two.relative());
    if (!(two.place.gap < real(0.05) * c.restGap) || !(v2 < 0) || !(v1 < 0)) return false;

    const Motion &a = motion(c.rowA), &b = motion(c.rowB);
    const Vec2 n = c.normal;
    const real k1 = compliance(a, one.place.armA, n) + compliance(b, one.place.armB, n);
    const real k2 = compliance(a, two.place.armA, n) + compliance(b, two.place.armB, n);
    const real k12 = (a.invMass.x + b.invMass.x) * n.x * n.x + (a.invMass.y + b.invMass.y) * n.y * n.y +
                     a.invInertia * cross(one.place.armA, n) * cross(two.place.armA, n) +
                     b.invInertia * cross(one.place.armB, n) * cross(two.place.armB, n);
    // One of the two may have no part in it: the first one hit then turns the body off the other.
    const real b1 = -(1 + restitution) * v1, b2 = -(1 + restitution) * v2;
    real j1, j2;
    if (!solveBlock(k1, k2, k12, -b1, -b2, j1, j2)) return false;

    if (j1 > 0) applyAt(c, one.place, j1 * n, t);
    if (j2 > 0) applyAt(c, two.place, j2 * n, t);
    const real f1 = j1 > 0 ? frictionImpulse(c, one, j1, t) : real(0);
    const real f2 = j2 > 0 ? frictionImpulse(c, two, j2, t) : real(0);
    c.points[first].stepNormal += j1;
    c.points[first].stepTangent += f1;
    c.points[second].stepNormal += j2;
    c.points[second].stepTangent += f2;
    if (j1 > 0) record(c, one, j1, f1, t, restitution);
    if (j2 > 0) record(c, two, j2, f2, t, restitution);
    return true;
}

// The contact's earliest impact, if there is one.
bool ImpactSolver::process(std::size_t i)
{
    Contact& c = contact(i);
    const Impact impacts[2] = {nextImpact(i, 0), nextImpact(i, 1)};
    const int first = impacts[1].time < impacts[0].time ? 1 : 0;

    // The earlier point, or the other one if by its true motion the earlier does not close.
    const real earliest = maximum(flights_[c.rowA].clock, flights_[c.rowB].clock);
    int k = first;
    real t = kNever;
    Moment moment;
    for (const int point : {first, 1 - first}) {
        if (impacts[point].time == kNever) continue;
        k = point;
        t = refined(c, c.points[k].anchor, impacts[k].time, earliest);
        moment = momentAt(c, c.points[k].anchor, t);
        if (dot(moment.normal, moment.relative()) < 0) break;
        t = kNever;
    }
    if (t == kNever) return false;

    // A crowded tick ends plastic, so that it ends.
    ++c.impacts;
    const real restitution = c.impacts > context_.tuning.impactsPerContact / 2 ? real(0) : c.restitution;
    if (c.impacts == context_.tuning.impactsPerContact) ++stage_.clamps.impactsPerContact;

    ++stage_.groups;
    if (c.count == 2 && processBoth(c, k, t, restitution)) return true;
    processOne(c, k, moment, t, restitution);
    return true;
}

SweptPair ImpactSolver::sweptPair(const Contact& c)
{
    SweptPair pair = sweptPairOf(c, stage_.world.shapes, motion(c.rowA), motion(c.rowB), context_.invH);
    const auto follow = [](Trajectory& path, const Flight& f) {
        path.position += f.offset;
        path.angle += static_cast<double>(f.turned);
        if (f.turned != 0) path.rotation = Rot::ofAngle(path.angle);
        path.velocity = f.velocity;
        path.spin = f.spin;
    };
    follow(pair.pathA, flights_[c.rowA]);
    follow(pair.pathB, flights_[c.rowB]);
    return pair;
}

// Does either body turn so far in the time left that its corners leave their chords by what counts
// as overlap? Then the pair may meet at another corner.
bool ImpactSolver::turnsOn(const Contact& c, real rest)
{
    const auto sagitta = [rest](real spin, real extent) { return spin * rest * (spin * rest) / 8 * extent; };
    return sagitta(flights_[c.rowA].spin, motion(c.rowA).extent) +
               sagitta(flights_[c.rowB].spin, motion(c.rowB).extent) >
           c.restGap / 2;
}

// A swept pair of a body that was hit: its way is another from then on. The pair that was hit itself
// is looked at again only if it turns on; loaded contacts keep their manifold.
void ImpactSolver::resweep(std::size_t i, bool own)
{
    Contact& c = contact(i);
    const Flight &fa = flights_[c.rowA], &fb = flights_[c.rowB];
    const real start = maximum(fa.clock, fb.clock);
    if (!c.swept || !(start < context_.h)) return;
    if (own && !turnsOn(c, context_.h - start)) return;
    for (int k = 0; k < c.count; ++k)
        if (c.points[k].normalImpulse > 0) return;

    const SweptResult result = collideSwept(sweptPair(c), start, context_.h);
    stage_.clamps.advancement += result.exhausted ? 1 : 0;
    adoptManifold(c, result, 0);
    prepareContact(c, motion(c.rowA), motion(c.rowB));
    placePoints(i);
}

// A body thrown out of the box it was paired in is paired again, at once.
void ImpactSolver::pairAgain(std::uint32_t row)
{
    const Motion& m = motion(row);
    const Flight& f = flights_[row];
    Trajectory path = predictedPath(m, m.center, context_.invH);
    path.position += f.offset;
    path.angle += static_cast<double>(f.turned);
    path.rotation = Rot::ofAngle(path.angle);
    path.velocity = f.velocity;
    path.spin = f.spin;
    const real end = static_cast<real>(context_.dt) - tickStart_;

    for (const std::uint32_t shape : stage_.world.bodies.rows[m.body].shapes) {
        const Convex& convex = stage_.world.shapes.rows[shape].convex;
        const real margin = 3 * stage_.world.restGap * convex.size;
        const Aabb needed = sweptBounds(convex, path, m.center, f.clock, end, margin);
        auto own = stage_.boxes.begin();
        while (own != stage_.boxes.end() && own->shape != shape) ++own;
        if (own == stage_.boxes.end() || contains(own->box, needed)) continue;

        std::vector<std::uint32_t> found;
        overlapping(stage_.boxes, needed, m.body, found);
        own->box = merged(own->box, needed);
        for (const std::uint32_t k : found) {
            const std::uint32_t other = stage_.boxes[k].shape;
            const ShapePair pair{minimum(shape, other), maximum(shape, other)};
            bool known = !mayCollide(stage_.world, pair);
            for (const Contact& c : stage_.contacts.rows)
                if (c.shapeA == pair.a && c.shapeB == pair.b) known = true;
            if (known) continue;
            Contact added = makeContact(stage_.world, pair);
            added.swept = true;
            stage_.contacts.order.push_back(static_cast<std::uint32_t>(stage_.contacts.rows.size()));
            stage_.contacts.rows.push_back(added);
            points_.resize(points_.size() + 2);
            ++stage_.repaired;
            resweep(stage_.contacts.rows.size() - 1, false);
        }
    }
}

void ImpactSolver::run()
{
    std::vector<bool> processed;
    for (int sweep = 0;; ++sweep) {
        if (sweep == context_.tuning.impactSweeps) {
            ++stage_.clamps.impactSweeps;
            return;
        }
        processed.assign(stage_.contacts.rows.size(), false);
        bool any = false;
        for (const std::uint32_t i : stage_.contacts.order) {
            const Contact& c = contact(i);
            const Flight &fa = flights_[c.rowA], &fb = flights_[c.rowB];
            if (c.count == 0 || (sweep > 0 && !fa.hit && !fb.hit && !fa.hitBefore && !fb.hitBefore)) continue;
            if (process(i)) processed[i] = any = true;
        }
        if (!any) return;
        for (std::size_t i = 0; i < processed.size(); ++i)
            if (flights_[contact(i).rowA].hit || flights_[contact(i).rowB].hit) resweep(i, processed[i]);
        for (std::uint32_t row = 0; row < flights_.size(); ++row)
            if (flights_[row].hit) pairAgain(row);
        for (Flight& f : flights_) {
            f.hitBefore = f.hit;
            f.hit = false;
        }
    }
}

}  // namespace

void applyImpacts(ImpactStage& stage, const StepContext& context, int tick)
{
    ImpactSolver(stage, context, tick).run();
}

void resweepForTick(ImpactStage& stage, const StepContext& context)
{
    for (Contact& c : stage.contacts.rows) {
        if (!c.swept) continue;
        const Motion &a = stage.motions.rows[c.rowA], &b = stage.motions.rows[c.rowB];
        const SweptPair pair = sweptPairOf(c, stage.world.shapes, a, b, context.invH);
        const SweptResult result = collideSwept(pair, 0, context.h);
        stage.clamps.advancement += result.exhausted ? 1 : 0;
        adoptManifold(c, result, real(0.3) * maximum(pair.a.size, pair.b.size));
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
