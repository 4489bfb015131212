// SPDX-License-Identifier: MIT
// Impulses at their time of impact, in the order of their times. A body hit at time t keeps its impulse
// as two kicks, before and after the drift, so that it ends up where a body hit at t would be: no
// position is ever corrected. docs/theory/contacts.md, section 3.

#include "solver/impacts.hpp"

#include "contacts/rows.hpp"
#include "contacts/update.hpp"
#include "solver/flight.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// An impact that awaits its turn.
struct Due {
    Impact impact;
    int before;              // impacts of the contact so far: of those at one time, take turns
    std::uint32_t place;     // of the contact in the order of solving
    std::uint32_t version;   // of the contact's motion when it was found

    bool operator<(const Due& other) const  // the heap has the greatest on top
    {
        if (impact.time != other.impact.time) return impact.time > other.impact.time;
        return before != other.before ? before > other.before : place > other.place;
    }
};

class ImpactSolver {
public:
    ImpactSolver(ImpactStage& stage, const StepContext& context, int tick);
    void run();

private:
    ImpactStage& stage_;
    const StepContext& context_;
    const real tickStart_;                   // within the step   [s]
    std::vector<Flight> flights_;            // by row
    std::vector<ImpactPoint> points_;        // two for each contact
    std::vector<std::uint32_t> versions_;    // by contact
    std::vector<std::uint32_t> places_;      // by contact
    std::vector<std::vector<std::uint32_t>> contactsOf_;  // by row; of bodies that move
    std::vector<Due> queue_;                 // a heap

    Contact& contact(std::uint32_t i) { return stage_.contacts.rows[i]; }
    Motion& motion(std::uint32_t row) { return stage_.motions.rows[row]; }
    FlyingPair pairOf(const Contact& c)
    {
        return {motion(c.rowA), motion(c.rowB), flights_[c.rowA], flights_[c.rowB]};
    }

    void connect();
    void placePoints(std::uint32_t i);
    void schedule(std::uint32_t i);
    void process(std::uint32_t i, const Impact& impact);
    bool processBoth(Contact& c, int first, real t, real restitution);
    void processOne(Contact& c, int point, real t, real restitution);
    real frictionImpulse(Contact& c, const Moment& moment, real normalImpulse, real t);
    void applyAt(const Contact& c, const PlacedPoint& place, Vec2 impulse, real t);
    void record(Contact& c, const Moment& before, real normalImpulse, real tangentImpulse, real t,
                real restitution);
    void follow(std::uint32_t row, std::uint32_t hit);
    Trajectory pathOf(std::uint32_t row, Position origin);
    bool turnsOn(const Contact& c, real rest);
    void resweep(std::uint32_t i, bool own);
    void pairAgain(std::uint32_t row);
    void add(const ShapePair& pair);
};

ImpactSolver::ImpactSolver(ImpactStage& stage, const StepContext& context, int tick)
    : stage_(stage), context_(context), tickStart_(static_cast<real>(tick) * context.h),
      flights_(stage.motions.rows.size()), points_(2 * stage.contacts.rows.size()),
      versions_(stage.contacts.rows.size()), places_(stage.contacts.rows.size())
{
    for (std::size_t row = 0; row < flights_.size(); ++row)
        flights_[row] = flightOf(stage.motions.rows[row], context.invH);
    for (std::uint32_t k = 0; k < places_.size(); ++k) {
        const std::uint32_t i = stage.contacts.order[k];
        contact(i).impacts = 0;
        contact(i).fastestImpact = 0;
        places_[i] = k;
        placePoints(i);
    }
}

void ImpactSolver::connect()
{
    if (!contactsOf_.empty()) return;
    contactsOf_.resize(flights_.size());
    for (const std::uint32_t i : stage_.contacts.order)
        for (const std::uint32_t row : {contact(i).rowA, contact(i).rowB})
            if (motion(row).moves()) contactsOf_[row].push_back(i);
}

void ImpactSolver::placePoints(std::uint32_t i)
{
    const Contact& c = contact(i);
    for (int k = 0; k < c.count; ++k)
        points_[2 * std::size_t{i} + static_cast<std::size_t>(k)] = impactPoint(c, k, pairOf(c));
}

void ImpactSolver::schedule(std::uint32_t i)
{
    const Contact& c = contact(i);
    ++versions_[i];
    const Impact impact = nextImpact(c, &points_[2 * std::size_t{i}], pairOf(c), context_);
    if (impact.time == kNever) return;
    queue_.push_back({impact, c.impacts, places_[i], versions_[i]});
    std::push_heap(queue_.begin(), queue_.end());
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
    hit.point = a.center + toDVec2(fa.shiftAt(t)) + toDVec2(before.place.armA);
    hit.normal = before.normal;
    hit.armA = before.place.armA;
    hit.armB = before.place.armB;
    hit.approachSpeed = -before.normalSpeed();
    c.fastestImpact = maximum(c.fastestImpact, hit.approachSpeed);
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
void ImpactSolver::processOne(Contact& c, int k, real t, real restitution)
{
    const Moment moment = momentAt(c, c.points[k].anchor, pairOf(c), t);
    const real mass = compliance(motion(c.rowA), moment.place.armA, moment.normal) +
                      compliance(motion(c.rowB), moment.place.armB, moment.normal);
    const real impulse = -(1 + restitution) * moment.normalSpeed() / mass;
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
    const FlyingPair pair = pairOf(c);
    const Moment one = momentAt(c, c.points[first].anchor, pair, t);
    const Moment two = momentAt(c, c.points[second].anchor, pair, t);
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

void ImpactSolver::process(std::uint32_t i, const Impact& impact)
{
    Contact& c = contact(i);
    // A crowded tick ends plastic, so that it ends.
    ++c.impacts;
    const real restitution = c.impacts > context_.tuning.impactsPerContact / 2 ? real(0) : c.restitution;
    if (c.impacts == context_.tuning.impactsPerContact) ++stage_.clamps.impactsPerContact;

    ++stage_.groups;
    if (c.count < 2 || !processBoth(c, impact.point, impact.time, restitution))
        processOne(c, impact.point, impact.time, restitution);
}

Trajectory ImpactSolver::pathOf(std::uint32_t row, Position origin)
{
    const Flight& f = flights_[row];
    Trajectory path = predictedPath(motion(row), origin, context_.invH);
    path.position += f.offset;
    path.angle += static_cast<double>(f.turned);
    if (f.turned != 0) path.rotation = Rot::ofAngle(path.angle);
    path.velocity = f.velocity;
    path.spin = f.spin;
    return path;
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

// A pair of a body that was hit: its way is another from then on. The pair that was hit itself is
// looked at again only if it turns on; loaded contacts keep their manifold.
void ImpactSolver::resweep(std::uint32_t i, bool own)
{
    Contact& c = contact(i);
    const real start = pairOf(c).start();
    for (int k = 0; k < c.count; ++k)
        if (c.points[k].normalImpulse > 0) return;
    c.swept = true;
    if (!(start < context_.h) || (own && !turnsOn(c, context_.h - start))) return;

    SweptPair pair = sweptPairOf(c, stage_.world.shapes, motion(c.rowA), motion(c.rowB), context_.invH);
    const Position origin = originOf(motion(c.rowA), motion(c.rowB));
    pair.pathA = pathOf(c.rowA, origin);
    pair.pathB = pathOf(c.rowB, origin);
    const SweptResult result = collideSwept(pair, start, context_.h);
    stage_.clamps.advancement += result.exhausted ? 1 : 0;
    adoptManifold(c, result, 0);
    prepareContact(c, motion(c.rowA), motion(c.rowB));
    placePoints(i);
}

void ImpactSolver::add(const ShapePair& pair)
{
    const auto i = static_cast<std::uint32_t>(stage_.contacts.rows.size());
    Contact added = makeContact(stage_.world, pair);
    added.swept = true;
    places_.push_back(static_cast<std::uint32_t>(stage_.contacts.order.size()));
    versions_.push_back(0);
    points_.resize(points_.size() + 2);
    stage_.contacts.order.push_back(i);
    stage_.contacts.rows.push_back(added);
    ++stage_.repaired;
    for (const std::uint32_t row : {added.rowA, added.rowB})
        if (motion(row).moves()) contactsOf_[row].push_back(i);
    resweep(i, false);
    schedule(i);
}

// A body thrown out of the box it was paired in is paired again, at once.
void ImpactSolver::pairAgain(std::uint32_t row)
{
    const Motion& m = motion(row);
    const Trajectory path = pathOf(row, m.center);
    const real end = static_cast<real>(context_.dt) - tickStart_;

    for (const std::uint32_t shape : stage_.world.bodies.rows[m.body].shapes) {
        const Convex& convex = stage_.world.shapes.rows[shape].convex;
        const real margin = 3 * stage_.world.restGap * convex.size;
        const Aabb needed = sweptBounds(convex, path, m.center, flights_[row].clock, end, margin);
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
            for (const std::uint32_t i : contactsOf_[row])
                if (contact(i).shapeA == pair.a && contact(i).shapeB == pair.b) known = true;
            if (!known) add(pair);
        }
    }
}

// What the impact of a contact changes for a body of it: all its contacts go another way.
void ImpactSolver::follow(std::uint32_t row, std::uint32_t hit)
{
    if (!motion(row).moves()) return;
    for (const std::uint32_t i : contactsOf_[row]) {
        resweep(i, i == hit);
        schedule(i);
    }
    pairAgain(row);
}

void ImpactSolver::run()
{
    for (const std::uint32_t i : stage_.contacts.order) schedule(i);
    while (!queue_.empty()) {
        std::pop_heap(queue_.begin(), queue_.end());
        const Due due = queue_.back();
        queue_.pop_back();
        const std::uint32_t i = stage_.contacts.order[due.place];
        if (due.version != versions_[i]) continue;
        connect();
        process(i, due.impact);
        follow(contact(i).rowA, i);
        follow(contact(i).rowB, i);
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
