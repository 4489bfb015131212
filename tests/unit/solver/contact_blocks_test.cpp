// SPDX-License-Identifier: MIT
// Passes over blocks of contacts give the bits that visiting the contacts one by one gives.
#include "contacts/rows.hpp"
#include "graph/coloring.hpp"
#include "solver/contact_blocks.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tamias2d {
namespace {

struct Heap {
    MotionTable motions;
    ContactTable contacts;
    Islands islands;
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
        m.velocity = {any(random), any(random)};
        m.spin = any(random);
        if (i > 0)
            m.invMass = {positive(random), 0}, m.invMass.y = m.invMass.x, m.invInertia = positive(random);
        heap.motions.rows.push_back(m);
        heap.islands.islandOf.push_back(i == 0 ? Islands::kNone : i % 2);
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
        c.restitution = random() % 5 == 0 ? real(0.5) : real(0);
        c.rolling = random() % 7 == 0 ? real(0.1) : real(0);
        c.impacts = random() % 9 == 0 ? 1 : 0;
        c.restGap = real(0.001);
        const Motion &a = heap.motions.rows[c.rowA], &b = heap.motions.rows[c.rowB];
        for (int k = 0; k < c.count; ++k) {
            ContactPointRow& p = c.points[k];
            p.armA = {any(random), any(random)};
            // Every sixth block is all but singular: both points at one place.
            p.armB = k == 1 && random() % 6 == 0 ? c.points[0].armB : Vec2{any(random), any(random)};
            if (k == 1 && p.armB == c.points[0].armB) p.armA = c.points[0].armA;
            p.gap = real(0.001) * any(random);
            p.normalImpulse = random() % 3 == 0 ? positive(random) : real(0);
            p.tangentImpulse = any(random) * p.normalImpulse;
            p.wasLoaded = p.normalImpulse > 0;
            p.normalMass = compliance(a, p.armA, c.normal) + compliance(b, p.armB, c.normal);
            p.tangentMass = compliance(a, p.armA, perpendicular(c.normal)) +
                            compliance(b, p.armB, perpendicular(c.normal));
        }
        c.crossMass = crossCompliance(a, b, c.normal, c.points[0].armA, c.points[0].armB, c.points[1].armA,
                                      c.points[1].armB);
        heap.contacts.rows.push_back(c);
        pairs.push_back({c.rowA, c.rowB});
    }
    std::vector<bool> movable;
    for (const Motion& m : heap.motions.rows) movable.push_back(m.moves());
    ColorScratch scratch;
    colorConstraints(pairs, movable, heap.contacts.order, heap.contacts.colorEnds, scratch);
    return heap;
}

// One after the other, in the order of colors.
void passOneByOne(Heap& heap, real restless, const std::vector<real>& before, std::vector<real>& unrest)
{
    for (const std::uint32_t i : heap.contacts.order) {
        Contact& c = heap.contacts.rows[i];
        if (c.count == 0) continue;
        const std::uint32_t island = islandOf(heap.islands, c.rowA, c.rowB);
        if (!before.empty() && !(before[island] > restless)) continue;
        Motion &a = heap.motions.rows[c.rowA], &b = heap.motions.rows[c.rowB];
        unrest[island] = maximum(unrest[island], solveContact(c, a, b, heap.context));
    }
}

TEST(ContactBlocks, GiveTheBitsOfVisitingContactsOneByOne)
{
    TRACES("ADR5", "ADR6", "ADR11");
    for (unsigned seed = 1; seed <= 60; ++seed) {
        // With two bodies each color has one contact; with many the blocks are full.
        Heap single = randomHeap(seed, 3 + seed * 2, 5 + seed * 4), wide = single;
        ContactBlocks blocks;
        gatherBlocks(wide.contacts, wide.motions, wide.islands, wide.context, blocks);
        std::vector<real> before;
        for (int pass = 0; pass < 3; ++pass) {
            std::vector<real> expected(2, 0), unrest(2, 0);
            passOneByOne(single, real(0.05), before, expected);
            passOver(blocks, wide.contacts, wide.motions, wide.islands, wide.context, real(0.05), before,
                     unrest);
            EXPECT_EQ(unrest, expected) << "seed " << seed << ", pass " << pass;
            before = {1, pass == 0 ? real(0) : real(1)};  // the second pass visits one island only
        }
        scatterBlocks(blocks, wide.contacts, wide.motions);
        for (std::size_t i = 0; i < wide.motions.rows.size(); ++i) {
            EXPECT_EQ(wide.motions.rows[i].velocity, single.motions.rows[i].velocity) << "body " << i;
            EXPECT_EQ(wide.motions.rows[i].spin, single.motions.rows[i].spin) << "body " << i;
        }
        for (std::size_t i = 0; i < wide.contacts.rows.size(); ++i) {
            for (int k = 0; k < wide.contacts.rows[i].count; ++k) {
                const ContactPointRow &p = wide.contacts.rows[i].points[k],
                                      &q = single.contacts.rows[i].points[k];
                EXPECT_EQ(p.normalImpulse, q.normalImpulse) << "contact " << i;
                EXPECT_EQ(p.tangentImpulse, q.tangentImpulse) << "contact " << i;
                EXPECT_EQ(p.stepNormal, p.normalImpulse) << "contact " << i;
            }
        }
    }
}

}  // namespace
}  // namespace tamias2d
