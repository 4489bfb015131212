// SPDX-License-Identifier: MIT
// Impacts in the order of their times: the earliest acts, and all contacts of its two bodies look again.
// docs/theory/contacts.md, section 3.

#include "solver/impacts.hpp"

#include "contacts/rows.hpp"
#include "contacts/update.hpp"
#include "solver/impact_response.hpp"

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
    ImpactResponse response_;
    std::vector<Due> queue_;                 // a heap

    Contact& contact(std::uint32_t i) { return stage_.contacts.rows[i]; }
    Motion& motion(std::uint32_t row) { return stage_.motions.rows[row]; }
    FlyingPair pairOf(const Contact& c) const { return response_.pairOf(c); }

    void connect();
    void placePoints(std::uint32_t i);
    void schedule(std::uint32_t i);
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
      versions_(stage.contacts.rows.size()), places_(stage.contacts.rows.size()),
      response_(stage, context, flights_, tickStart_)
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

// What the impact of a contact changes for a body of it: all its other contacts go another way.
void ImpactSolver::follow(std::uint32_t row, std::uint32_t hit)
{
    if (!motion(row).moves()) return;
    for (const std::uint32_t i : contactsOf_[row]) {
        if (i == hit) continue;
        resweep(i, false);
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
        response_.act(contact(i), due.impact);
        resweep(i, true);
        schedule(i);
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
