// SPDX-License-Identifier: MIT
// Impacts that the passes stop make hits like those at their times. docs/theory/contacts.md, section 3.

#include "solver/pass_hits.hpp"

#include "contacts/rows.hpp"
#include "solver/impact_response.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// The way of a body through the tick, with all impacts of it and without the passes. What carries a load
// keeps its speed: its forces are balanced.
Flight wayOf(const ImpactStage& stage, std::uint32_t row, real h)
{
    const Motion& m = stage.motions.rows[row];
    const LaneRow &start = stage.rows.starts[row], &expected = stage.rows.expected[row];
    const ImpactKick& kick = stage.rows.kicks[row];
    Flight way;
    way.velocity = {start.x, start.y};
    way.spin = start.z;
    if (!m.moves()) return way;
    // An impact at t is given in parts of 1 - t/h before the drift and t/h after it.
    way.velocity += kick.before + kick.after;
    way.spin += kick.spinBefore + kick.spinAfter;
    way.offset = -h * kick.after;
    way.turned = -h * kick.spinAfter;
    if (m.isLoaded()) return way;
    way.acceleration = {expected.x, expected.y};
    way.spinRate = expected.z;
    return way;
}

// As impactThreshold; but what a body that was stopped in the last tick carried then is no steady force.
real steadyApproach(const Contact& c, const Motion& a, const Motion& b, const StepContext& context)
{
    const Vec2 n = c.normal;
    const auto carried = [&](const Motion& m) {
        return minimum(absolute(dot(n, m.steady)), context.h * length(m.acceleration));
    };
    return impactThreshold(c, a, b, carried(a) + carried(b), context);
}

// Is the contact one of those whose impacts are left to the passes?
bool isLeftToPasses(const Contact& c, const StepContext& context)
{
    return c.crowded || c.impacts >= mostImpacts(c, context);
}

// Will an impact of the next tick stop what is left of the approach? Then that makes the hit.
bool isLeftForNext(const Contact& c, real approach, real gap, const StepContext& context)
{
    const real slowest = leastApproach(c, context);
    return c.impacts < mostImpacts(c, context) && approach > slowest && gap * context.invH > slowest;
}

// What a lane says of a contact, of one that is loose.
LaneView viewOf(const Contact& c)
{
    LaneView view{};
    view.normal = c.normal;
    for (int k = 0; k < c.count; ++k) {
        const ContactPointRow& p = c.points[k];
        view.points[k] = {
            cross(p.armA, c.normal), cross(p.armB, c.normal), p.gap, p.normalMass > 0, p.wasLoaded,
            p.normalImpulse,         p.tangentImpulse};
    }
    return view;
}

class PassHits {
public:
    PassHits(ImpactStage& stage, const StepContext& context, int tick)
        : stage_(stage), context_(context), tickStart_(timeOf(tick, context).start)
    {
    }

    // Of a contact of which a point is newly loaded.
    void look(std::uint32_t i)
    {
        Contact& c = stage_.contacts.rows[i];
        if (!isLeftToPasses(c, context_)) return;
        const LaneView view = stage_.passes.isInLane(i) ? stage_.passes.view(i) : viewOf(c);
        c.normal = view.normal;
        const Flight wayA = wayOf(stage_, c.rowA, context_.h), wayB = wayOf(stage_, c.rowB, context_.h);
        bool isFirst = true;
        for (int k = 0; k < c.count; ++k) {
            const LaneView::Point& p = view.points[k];
            if (p.wasLoaded || !(p.normalImpulse > 0)) continue;
            const real t = hitTime(c, p, wayA, wayB);
            if (t == kNever) continue;
            if (isFirst) ++stage_.groups;
            isFirst = false;
            record(c, p, momentOf(c, k, wayA, wayB, t), wayA, t);
        }
    }

private:
    ImpactStage& stage_;
    const StepContext& context_;
    const real tickStart_;   // within the step   [s]

    const Motion& motion(std::uint32_t row) const { return stage_.motions.rows[row]; }

    // When the point closed, too fast for a steady force; kNever if it did not. What passes leave undone is
    // no impact either, nor is what is left of one that has acted in this tick.
    real hitTime(const Contact& c, const LaneView::Point& p, const Flight& wayA, const Flight& wayB) const
    {
        const real h = context_.h, restless = context_.tuning.restless * context_.lengthUnit;
        const Closing closing({c.normal, p.turnA, p.turnB, p.gap}, wayA, wayB);
        if (!(minimum(closing.speed, closing.at(h)) < -restless)) return kNever;
        const real t = minimum(closingTime(p.gap + closing.offset, closing.speed, closing.push), h);
        const real approach = -closing.at(t);
        if (!(approach > maximum(restless, steadyApproach(c, motion(c.rowA), motion(c.rowB), context_))))
            return kNever;
        if (c.impacts > 0 && !(approach > c.fastestImpact)) return kNever;
        return isLeftForNext(c, approach, p.gap, context_) ? kNever : t;
    }

    // Where the pass acted, and velocities of when the point closed.
    Moment momentOf(const Contact& c, int k, const Flight& wayA, const Flight& wayB, real t) const
    {
        const Motion &a = motion(c.rowA), &b = motion(c.rowB);
        Moment at;
        at.normal = c.normal;
        at.place =
            placePoint(c, c.normal, c.points[k].anchor, a.rotation, b.rotation, toVec2(b.center - a.center));
        at.velocityA = wayA.velocity + t * wayA.acceleration;
        at.velocityB = wayB.velocity + t * wayB.acceleration;
        at.spinA = wayA.spin + t * wayA.spinRate;
        at.spinB = wayB.spin + t * wayB.spinRate;
        return at;
    }

    void record(const Contact& c, const LaneView::Point& p, const Moment& at, const Flight& wayA, real t)
    {
        ImpactRecord entry = recordOf(c, at, motion(c.rowA).center + toDVec2(wayA.shiftAt(t)));
        entry.number = static_cast<std::uint32_t>(stage_.records.size());
        HitEvent& hit = entry.hit;
        hit.time = context_.time + static_cast<double>(tickStart_) + static_cast<double>(t);
        hit.normalImpulse = p.normalImpulse;
        hit.tangentImpulse = p.tangentImpulse;
        hit.group = stage_.groups;
        hit.simultaneous = true;
        stage_.records.push_back(entry);
    }
};

}  // namespace

void recordPassHits(ImpactStage& stage, const StepContext& context, int tick)
{
    PassHits hits(stage, context, tick);
    for (const std::uint32_t i : stage.passes.newlyLoaded(stage.contacts)) hits.look(i);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
