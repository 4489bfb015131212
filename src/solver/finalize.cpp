// SPDX-License-Identifier: MIT
#include "solver/finalize.hpp"

#include "contacts/rows.hpp"
#include "contacts/update.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

bool isNumber(const Motion& m)
{
    return isFinite(m.center) && std::isfinite(m.angle) && isFinite(m.velocity) && std::isfinite(m.spin);
}

// Holds the body at the edge of the world, without the speed that led there.
bool stopAtEdge(Motion& m, real lengthUnit)
{
    const double most = kMaxPosition * static_cast<double>(lengthUnit);
    const Position inside{clamp(m.center.x, -most, most), clamp(m.center.y, -most, most)};
    if (inside == m.center) return false;
    if (inside.x != m.center.x) m.velocity.x = 0;
    if (inside.y != m.center.y) m.velocity.y = 0;
    m.center = inside;
    return true;
}

}  // namespace

void remember(BodyRow& b)
{
    b.previousCenter = b.center;
    b.previousAngle = b.angle;
    b.previousLocalCenter = b.localCenter;
    b.stepForce = {};
    b.stepTorque = 0;
}

FinalCounts finalize(MotionTable& motions, ContactTable& contacts, const ShapeTable& shapes,
                     BodyTable& bodies, const StepContext& context)
{
    FinalCounts counts;
    for (Motion& m : motions.rows) {
        BodyRow& b = bodies.rows[m.body];
        if (!b.takesPart) continue;
        remember(b);
        if (!isNumber(m)) {
            b.velocity = {};
            b.spin = 0;
            b.enabled = false;
            m.center = b.center;
            m.angle = b.angle;
            m.rotation = b.rotation;
            ++counts.nonFinite;
            continue;
        }
        counts.stopped += stopAtEdge(m, context.lengthUnit) ? 1 : 0;
        b.center = m.center;
        b.angle = m.angle;
        b.rotation = m.rotation;
        b.velocity = m.velocity;
        b.spin = m.spin;
    }

    // Where the contacts are now. A swept pair's manifold may be stale by now: its nearest features
    // are looked up again, so that touching and separation are those of the final poses.
    for (Contact& c : contacts.rows) {
        const Motion &a = motions.rows[c.rowA], &b = motions.rows[c.rowB];
        if (c.swept) {
            const SweptPair pair = sweptPairOf(c, shapes, a, b, context.invH);
            SweptResult nearest;
            if (c.clearance <= 3 * c.restGap) nearest = nearestAt(pair, 0);
            adoptManifold(c, nearest, real(0.3) * maximum(pair.a.size, pair.b.size));
        }
        prepareContact(c, a, b);
        for (int i = 0; i < c.count; ++i) {
            const double overlap = -static_cast<double>(c.points[i].gap + c.restGap);
            if (overlap > counts.deepestOverlap) counts.deepestOverlap = overlap;
        }
    }
    return counts;
}

bool isTouching(const Contact& contact, const Tuning& tuning)
{
    for (int i = 0; i < contact.count; ++i)
        if (contact.points[i].gap <= (tuning.touchingFactor - 1) * contact.restGap) return true;
    return false;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
