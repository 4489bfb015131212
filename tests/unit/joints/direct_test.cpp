// SPDX-License-Identifier: MIT
// Ropes solved at once, against what defines their answer: each pulls and is taut, or is slack and does
// nothing.
#include "joints/direct.hpp"
#include "support/random.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tamias2d {
namespace {

using namespace test;

// Discs in a tangle, each tied to the one before and the first to a hook, that go about the same way; the
// last one is heavy. Some ropes are slack. What they carry from before is far more than there is to bear.
struct Ropes {
    Table<Motion> motions{1};  // the hook
    std::vector<JointRows> joints;
    std::vector<BodyMotion<real>> velocities;
    DirectGroup group;

    static Vec2 both(double x, double y) { return {static_cast<real>(x), static_cast<real>(y)}; }

    explicit Ropes(std::uint32_t seed)
    {
        Random random(seed);
        const int count = static_cast<int>(random.between(8, 20));
        const double carried = std::pow(10, random.between(2, 5));  // at most   [N*s]
        const double load = std::pow(10, random.between(0, 5));
        for (int i = 1; i <= count; ++i) {
            const double angle = random.between(-3.14159265358979, 3.14159265358979),
                         inverse = i < count ? 1 : 1 / load;
            const double stray = std::pow(10, random.between(-5, 0.5));
            const double slack =
                random.between(0, 1) < 0.5 ? 0 : std::pow(10, random.between(-7, i > 1 ? 0 : 2));
            Motion disc;
            disc.invMass = both(inverse, inverse);
            disc.velocity = both(stray * random.between(-1, 1), stray * random.between(-1, 1) - 6);
            motions.push_back(disc);
            const Vec2 line = both(std::cos(angle), std::sin(angle));
            JointRows rope;
            rope.rowA = static_cast<std::uint32_t>(i - 1);
            rope.rowB = static_cast<std::uint32_t>(i);
            rope.rigidly = true;
            ConstraintRow& row = rope.add(RowKind::Limit, 0, {line, -line, 0, 0}, 0, false);
            row.bears = true;
            row.mass = motions[rope.rowA].invMass.x + disc.invMass.x;
            rope.visits[0].high = kUnlimited;
            rope.visits[0].bias = static_cast<real>(slack);
            rope.visits[0].impulse = static_cast<real>(carried * random.between(0, 1));
            group.joints.push_back(static_cast<std::uint32_t>(joints.size()));
            joints.push_back(rope);
        }
        for (const JointRows& rope : joints) {
            Motion &a = motions[rope.rowA], &b = motions[rope.rowB];
            a.velocity += rope.visits[0].impulse * a.invMass.x * rope.rows[0].j.linearA;
            b.velocity += rope.visits[0].impulse * b.invMass.x * rope.rows[0].j.linearB;
        }
        group.build(joints, motions);
        for (const std::uint32_t row : group.rows)
            velocities.push_back({motions[row].velocity, motions[row].spin});
    }

    // How fast a rope's length grows beyond what it is, at most.   [m/s]
    double speedOf(std::size_t j) const
    {
        const JointRows& rope = joints[j];
        const BodyMotion<real> a = rope.rowA == 0 ? BodyMotion<real>{} : velocities[rope.rowA - 1];
        return static_cast<double>(speedAlong(rope.rows[0].j, a, velocities[rope.rowB - 1]) +
                                   rope.visits[0].bias);
    }
    double impulseOf(std::size_t j) const { return static_cast<double>(joints[j].visits[0].impulse); }
};

TEST(Direct, RopesArePulledTautOrAreSlackAndDoNothing)
{
    TRACES("LC3", "NFR2");
    for (std::uint32_t seed = 1; seed <= 500; ++seed) {
        Ropes ropes(seed);
        ASSERT_GE(solveDirect(ropes.group, ropes.joints, ropes.motions, ropes.velocities), 0) << seed;
        for (std::size_t j = 0; j < ropes.joints.size(); ++j) {
            EXPECT_GE(ropes.impulseOf(j), 0) << "trial " << seed << ", rope " << j;
            EXPECT_GT(ropes.speedOf(j), -1e-3) << "trial " << seed << ", rope " << j;
            const double pull = ropes.speedOf(j) > 1e-3 ? ropes.impulseOf(j) : 0;
            EXPECT_LT(pull, 1e-3) << "trial " << seed << ", rope " << j;
        }
    }
}

// In these some hop between slack and taut, and are made rigid by and by: what was solved while they gave way
// counts for no answer.
TEST(Direct, RopesThatWereSolvedSoftlyFirstAreAsTautAsAnyOther)
{
    TRACES("LC3", "NFR2");
    const double bar = std::numeric_limits<real>::digits > 24 ? 1e-11 : 1e-4;  // [m/s]
    for (const std::uint32_t seed : {61u, 222u, 293u, 299u, 393u, 421u, 436u, 495u}) {
        Ropes ropes(seed);
        ASSERT_GE(solveDirect(ropes.group, ropes.joints, ropes.motions, ropes.velocities), 0) << seed;
        for (std::size_t j = 0; j < ropes.joints.size(); ++j) {
            EXPECT_GT(ropes.speedOf(j), -bar) << "trial " << seed << ", rope " << j;
            const double slack = ropes.impulseOf(j) > 1e-3 ? ropes.speedOf(j) : 0;
            EXPECT_LT(slack, bar) << "trial " << seed << ", rope " << j;
        }
    }
}

}  // namespace
}  // namespace tamias2d
