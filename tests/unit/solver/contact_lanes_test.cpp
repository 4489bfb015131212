// SPDX-License-Identifier: MIT
// Passes over contacts in lanes give the bits that visiting the contacts one by one gives, with any width.
#include "contacts/rows.hpp"
#include "contacts/step_manifolds.hpp"
#include "graph/coloring.hpp"
#include "solver/contact_passes.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tamias2d {
namespace {

struct Heap {
    MotionTable motions;
    ContactTable contacts;
    Islands islands;
    TickRows rows;
    StepContext context = makeStepContext({}, 1, 0, 1.0 / 60, 4);
};

// Bodies in no order, the first one a ground; contacts of all kinds between them, in colors; two islands.
Heap randomHeap(unsigned seed, std::uint32_t bodies, std::uint32_t contacts)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<real> any(-1, 1), positive(real(0.1), 2);
    Heap heap;
    for (std::uint32_t i = 0; i < bodies; ++i) {
        Motion m;
        m.center = {double(any(random)), double(any(random))};
        m.rotation = Rot::ofAngle(double(3 * any(random)));
        m.velocity = {any(random), any(random)};
        m.spin = any(random);
        if (i > 0) {
            m.invMass = {positive(random), 0};
            m.invMass.y = random() % 8 == 0 ? real(0) : m.invMass.x;
            m.invInertia = positive(random);
        }
        heap.motions.rows.push_back(m);
        heap.islands.islandOf.push_back(i == 0 ? Islands::kNone : i % 2);
        heap.rows.origins.push_back({m.center});
        heap.rows.poses.push_back(poseRow(m, m.center));
        heap.rows.velocities.push_back(laneRow(velocityOf(m)));
        heap.rows.pushes.push_back({});
    }
    heap.islands.groundOf = {0, 0};
    heap.islands.sizeOf = {bodies / 2, bodies / 2};
    std::vector<RowPair> pairs;
    while (heap.contacts.rows.size() < contacts) {
        Contact c;
        c.rowA = static_cast<std::uint32_t>(random() % bodies);
        c.rowB = c.rowA + 2 * static_cast<std::uint32_t>(random() % 4 + 1);  // of the same island
        if (c.rowA == 0) c.rowB = static_cast<std::uint32_t>(random() % (bodies - 1)) + 1;
        if (c.rowB >= bodies) continue;
        const real angle = 3 * any(random);
        c.normal = rotate(Rot::ofAngle(static_cast<double>(angle)), Vec2{1, 0});
        c.count = static_cast<int>(random() % 3);
        c.friction = positive(random);
        c.surfaceSpeed = random() % 4 == 0 ? any(random) : real(0);
        c.restitution = random() % 5 == 0 ? real(0.5) : real(0);
        c.rolling = random() % 7 == 0 ? real(0.1) : real(0);
        c.restGap = real(0.001);
        c.radiusA = random() % 2 == 0 ? positive(random) : real(0);
        c.radiusB = random() % 2 == 0 ? positive(random) : real(0);
        for (int k = 0; k < c.count; ++k) {
            ContactPointRow& p = c.points[k];
            // Every sixth block is all but singular: both points at one place.
            const bool same = k == 1 && random() % 6 == 0;
            p.anchor = same ? c.points[0].anchor
                            : ManifoldPoint{{any(random), any(random)}, {any(random), any(random)}};
            p.anchor.cornerOnA = random() % 2 == 0;
            p.anchor.roundOnRound = c.count == 1 && random() % 2 == 0;
            p.normalImpulse = random() % 3 == 0 ? positive(random) : real(0);
            p.tangentImpulse = any(random) * p.normalImpulse;
        }
        heap.contacts.rows.push_back(c);
        pairs.push_back({c.rowA, c.rowB});
    }
    std::vector<bool> movable;
    for (const Motion& m : heap.motions.rows) movable.push_back(m.moves());
    ColorScratch scratch;
    colorConstraints(pairs, movable, heap.contacts.order, heap.contacts.colorEnds, scratch);
    return heap;
}

// One after the other, in the order of colors: as many passes as the islands ask for.
void solveOneByOne(Heap& heap)
{
    const real restless = heap.context.tuning.restless;
    std::vector<bool> unrest(2, true);
    for (int pass = 0; pass <= heap.context.tuning.extraPasses; ++pass) {
        const std::vector<bool> visited = unrest;
        unrest.assign(2, false);
        for (const std::uint32_t i : heap.contacts.order) {
            Contact& c = heap.contacts.rows[i];
            const std::uint32_t island = islandOf(heap.islands, c.rowA, c.rowB);
            if (!visited[island]) continue;
            const real change =
                solveContact(c, heap.motions.rows[c.rowA], heap.motions.rows[c.rowB], heap.context);
            if (change > restless) unrest[island] = true;
        }
    }
}

void prepareOneByOne(Heap& heap)
{
    for (Contact& c : heap.contacts.rows) {
        prepareContact(c, heap.motions.rows[c.rowA], heap.motions.rows[c.rowB]);
        for (int k = 0; k < c.count; ++k) c.points[k].wasLoaded = c.points[k].normalImpulse > 0;
    }
}

// Returns the contacts that touch now and did not, or the reverse.
std::vector<std::uint32_t> endStep(ContactPasses& passes, Heap& heap)
{
    std::vector<std::uint32_t> changed;
    heap.contacts.nearness.resize(heap.contacts.rows.size());
    heap.contacts.loads.resize(heap.contacts.rows.size());
    passes.end(heap.contacts, {});
    passes.conclude(heap.rows, heap.context, heap.contacts, changed);
    passes.tell(heap.contacts);
    return changed;
}

constexpr LaneWidth kWidths[] = {LaneWidth::Scalar, LaneWidth::Bytes16, LaneWidth::Bytes32,
                                 LaneWidth::Bytes64};

TEST(ContactLanes, GiveTheBitsOfVisitingContactsOneByOne)
{
    TRACES("ADR5", "ADR6", "ADR11");
    Profile profile;
    Parallel parallel(3, nullptr, profile);
    for (const LaneWidth width : kWidths) {
        if (!hasLanes(width)) continue;
        for (unsigned seed = 1; seed <= 60; ++seed) {
            // With two bodies each color has one contact; with many the blocks are full, and at last there
            // are enough in a color to be shared out to threads.
            const unsigned size = seed < 55 ? seed : 50 * seed;
            Heap single = randomHeap(seed, 3 + size * 2, 5 + size * 4), wide = single;
            prepareOneByOne(single);
            solveOneByOne(single);

            ContactPasses passes(parallel);
            passes.use(width, wide.contacts);
            passes.begin(wide.contacts, wide.motions, wide.islands, wide.rows, wide.context, false, {});
            passes.prepare(wide.contacts, wide.motions, wide.rows, wide.context);
            passes.solve(wide.contacts, wide.motions, wide.rows, wide.context);
            passes.finish(wide.contacts, wide.motions, wide.rows);
            passes.addUp(wide.contacts, wide.motions, wide.context);
            endStep(passes, wide);

            for (std::size_t i = 0; i < wide.motions.rows.size(); ++i) {
                const LaneRow& row = wide.rows.velocities[i];
                const Motion& expected = single.motions.rows[i];
                EXPECT_EQ((Vec2{row.x, row.y}), expected.velocity) << "body " << i << ", seed " << seed;
                EXPECT_EQ(row.z, expected.spin) << "body " << i << ", seed " << seed;
            }
            for (std::size_t i = 0; i < wide.contacts.rows.size(); ++i) {
                for (int k = 0; k < wide.contacts.rows[i].count; ++k) {
                    const ContactPointRow &p = wide.contacts.rows[i].points[k],
                                          &q = single.contacts.rows[i].points[k];
                    EXPECT_EQ(p.normalImpulse, q.normalImpulse) << "contact " << i << ", seed " << seed;
                    EXPECT_EQ(p.tangentImpulse, q.tangentImpulse) << "contact " << i << ", seed " << seed;
                    EXPECT_EQ(p.stepNormal, p.normalImpulse) << "contact " << i << ", seed " << seed;
                }
            }
        }
    }
}

// What the contacts carry is added in the order of colors, the loose ones last: the same for all widths.
TEST(ContactLanes, GiveTheSameBitsWithAnyWidth)
{
    TRACES("ADR5", "ADR6");
    Profile profile;
    Parallel parallel(1, nullptr, profile);
    for (unsigned seed = 1; seed <= 30; ++seed) {
        const Heap start = randomHeap(seed, 3 + seed * 2, 5 + seed * 4);
        Heap first;
        for (const LaneWidth width : kWidths) {
            if (!hasLanes(width)) continue;
            Heap heap = start;
            ClampCounts clamps;
            ContactPasses passes(parallel);
            passes.use(width, heap.contacts);
            passes.begin(heap.contacts, heap.motions, heap.islands, heap.rows, heap.context, false, {});
            for (int tick = 0; tick < 3; ++tick) {
                passes.prepare(heap.contacts, heap.motions, heap.rows, heap.context);
                passes.solve(heap.contacts, heap.motions, heap.rows, heap.context);
                passes.finish(heap.contacts, heap.motions, heap.rows);
                passes.addUp(heap.contacts, heap.motions, heap.context);
                passes.pushApart(heap.contacts, heap.motions, heap.rows, heap.context, clamps);
            }
            endStep(passes, heap);
            if (width == LaneWidth::Scalar) {
                first = heap;
                continue;
            }
            for (std::size_t i = 0; i < heap.motions.rows.size(); ++i) {
                EXPECT_EQ(heap.motions.rows[i].steady, first.motions.rows[i].steady) << "seed " << seed;
                EXPECT_EQ(heap.motions.rows[i].steadySpin, first.motions.rows[i].steadySpin)
                    << "seed " << seed;
                for (real LaneRow::* part : {&LaneRow::x, &LaneRow::y, &LaneRow::z}) {
                    EXPECT_EQ(heap.rows.pushes[i].*part, first.rows.pushes[i].*part) << "seed " << seed;
                    EXPECT_EQ(heap.rows.velocities[i].*part, first.rows.velocities[i].*part)
                        << "seed " << seed;
                }
            }
            for (std::size_t i = 0; i < heap.contacts.rows.size(); ++i) {
                EXPECT_EQ(heap.contacts.rows[i].stepImpulse, first.contacts.rows[i].stepImpulse)
                    << "contact " << i << ", seed " << seed;
            }
        }
    }
}

// What lanes hand on from step to step is what the rows of the table say, once these have been told.
TEST(ContactLanes, SayAtTheEndWhatTheTableWouldSay)
{
    TRACES("ADR6", "ADR27");
    Profile profile;
    Parallel parallel(1, nullptr, profile);
    const real error = sizeof(real) == sizeof(double) ? real(1e-12) : real(2e-5);
    int changes = 0;
    for (unsigned seed = 1; seed <= 30; ++seed) {
        Heap heap = randomHeap(seed, 3 + seed * 2, 5 + seed * 4);
        ContactPasses passes(parallel);
        passes.use(kWidths[seed % 2], heap.contacts);
        passes.begin(heap.contacts, heap.motions, heap.islands, heap.rows, heap.context, false, {});
        passes.prepare(heap.contacts, heap.motions, heap.rows, heap.context);
        passes.solve(heap.contacts, heap.motions, heap.rows, heap.context);
        passes.finish(heap.contacts, heap.motions, heap.rows);
        passes.addUp(heap.contacts, heap.motions, heap.context);
        const Table<Contact> before = heap.contacts.rows;
        const std::vector<std::uint32_t> changed = endStep(passes, heap);
        std::vector<std::uint32_t> touch;
        for (std::uint32_t i = 0; i < before.size(); ++i) {
            if (!passes.isInLane(i)) continue;
            const Contact& c = heap.contacts.rows[i];
            const std::string where = "contact " + std::to_string(i) + ", seed " + std::to_string(seed);
            Contact placed = c;
            placeContact(placed, heap.motions.rows[c.rowA], heap.motions.rows[c.rowB]);
            for (int k = 0; k < c.count; ++k) {
                const ContactPointRow &p = c.points[k], &q = placed.points[k];
                EXPECT_NEAR(p.gap, q.gap, error) << where;
                EXPECT_LT(length(p.armA - q.armA) + length(p.armB - q.armB), 4 * error) << where;
            }
            const ContactLoad load = loadOf(placed), &told = heap.contacts.loads[i];
            EXPECT_LT(length(told.impulse - load.impulse), 8 * error) << where;
            EXPECT_NEAR(told.momentA, load.momentA, 40 * error) << where;
            EXPECT_NEAR(told.momentB, load.momentB, 40 * error) << where;
            EXPECT_EQ(heap.contacts.nearness[i], nearnessOf(c, heap.context.tuning)) << where;
            if (isTouching(c, heap.context.tuning)) touch.push_back(i);
        }
        std::vector<std::uint32_t> sorted = changed;
        std::sort(sorted.begin(), sorted.end());
        EXPECT_EQ(sorted, touch) << "none touched before, seed " << seed;
        changes += static_cast<int>(changed.size());
    }
    EXPECT_GT(changes, 50);
}

}  // namespace
}  // namespace tamias2d
