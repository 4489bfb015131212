// SPDX-License-Identifier: MIT
// Coulomb friction at an impact: from the slip that the normal impulse leaves.
#include <support/build.hpp>
#include <support/impacts.hpp>
#include <support/run.hpp>
#include <support/traces.hpp>

#include <cmath>

namespace tamias2d::test {
namespace {

// Steps until the first hit, and returns it.
HitEvent firstHit(World& world)
{
    for (int i = 0; i < 600 && world.events().hits.empty(); ++i) world.step();
    return world.events().hits.empty() ? HitEvent{} : world.events().hits[0];
}

TEST(ImpactFriction, IsMuTimesTheNormalImpulseWhileItSlides)
{
    TRACES("R8", "LC2");
    for (const double mu : {0.125, 0.3, 0.6}) {
        for (const double e : {0.0, 0.3, 0.8, 1.0}) {
            World world(weightless());
            const Body ball = addDisc(world, {0, 2}, 0.5,
                                      {.velocity = vec(40, -5), .spin = 3, .friction = mu, .restitution = e});
            addGround(world, 0, 1000, {.friction = mu});
            const HitEvent hit = firstHit(world);
            ASSERT_GT(hit.normalImpulse, 0);
            // sqrt(mu mu) is mu, so the two sides differ by the rounding of one product
            const double ratio =
                std::abs(static_cast<double>(hit.tangentImpulse)) / static_cast<double>(hit.normalImpulse);
            EXPECT_LE(relativeError(ratio, mu), byPrecision(1e-15, 3e-7)) << mu << " " << e;
            EXPECT_LT(velocityOf(ball).x, 40);
            const double j = static_cast<double>(ball.mass()) * (1 + e) * 5;
            EXPECT_LE(relativeError(static_cast<double>(hit.normalImpulse), j), kExact);
            EXPECT_LE(relativeError(velocityOf(ball).x, 40 - mu * (1 + e) * 5), kExact);
        }
    }
}

TEST(ImpactFriction, StopsTheSlipOfABallThatGrips)
{
    TRACES("R8", "LC2");
    for (const double e : {0.3, 1.0}) {
        World world(weightless());
        const Body ball = addDisc(world, {0, 2}, 0.5, {.velocity = vec(0, -5), .spin = -6, .restitution = e});
        addGround(world);
        const HitEvent hit = firstHit(world);
        ASSERT_GT(hit.normalImpulse, 0);
        // A disc that comes down with backspin w rolls off at w r / 3; the gap lengthens its arm a little.
        EXPECT_LE(relativeError(velocityOf(ball).x, 1), 3e-3);
        const DVec2 arm = toDVec2(hit.bodyB == ball.id() ? hit.armB : hit.armA);
        const DVec2 slip = velocityOf(ball) + cross(spinOf(ball), arm);
        EXPECT_LE(std::abs(slip.x), 5 * kExact);
        EXPECT_LE(relativeError(velocityOf(ball).y, 5 * e), kExact);
    }
}

TEST(ImpactFriction, ComesFromTheSlipAfterTheNormalImpulse)
{
    TRACES("R8", "LC2", "ADR16");
    // A tilted rod falls straight: there is no slip before, but the blow turns it and makes its foot slide.
    for (const double mu : {0.1, 2.0}) {
        World world(weightless());
        const Body rod =
            addBox(world, {0, 2}, 2, 0.1,
                   {.velocity = vec(0, -5), .angle = kPi / 4, .friction = mu, .restitution = 0.5});
        addGround(world, 0, 100, {.friction = mu});
        const Movers before = moversOf(world);
        const HitEvent hit = firstHit(world);
        ASSERT_GT(hit.normalImpulse, 0);
        Mover a = before.at(hit.bodyA), b = before.at(hit.bodyB);
        const DVec2 n = toDVec2(hit.normal), t = perpendicular(n);
        EXPECT_LE(std::abs(dot(t, slipAt(hit, a, b))), 5 * kExact);

        const double j = 1.5 * 5 / mobility(hit, hit, n, a, b);
        EXPECT_LE(relativeError(static_cast<double>(hit.normalImpulse), j), kExact);
        push(a, -j * n, toDVec2(hit.armA));
        push(b, j * n, toDVec2(hit.armB));
        const double stop = -dot(t, slipAt(hit, a, b)) / mobility(hit, hit, t, a, b);
        EXPECT_GT(std::abs(stop), 0.1 * j);
        const double tangent = std::clamp(stop, -mu * j, mu * j);
        EXPECT_LE(relativeError(static_cast<double>(hit.tangentImpulse), tangent), kExact);
        // A foot that grips is pushed into the ground again: smaller impacts follow at the same time.
        double given = 0;
        for (const HitEvent& each : world.events().hits) {
            given += (each.bodyB == rod.id() ? 1 : -1) * static_cast<double>(each.tangentImpulse) * t.x;
            EXPECT_NEAR(each.time, hit.time, byPrecision(1e-9, 1e-5));
        }
        EXPECT_LE(relativeError(velocityOf(rod).x, given / static_cast<double>(rod.mass())), kExact);
    }
}

TEST(ImpactFriction, IsMixedByTheRootOfTheProduct)
{
    TRACES("R3", "LC2");
    World world(weightless());
    addDisc(world, {0, 2}, 0.5, {.velocity = vec(40, -5), .friction = 0.2, .restitution = 1});
    addGround(world, 0, 1000, {.friction = 0.8});
    const HitEvent hit = firstHit(world);
    ASSERT_GT(hit.normalImpulse, 0);
    const double ratio =
        std::abs(static_cast<double>(hit.tangentImpulse)) / static_cast<double>(hit.normalImpulse);
    EXPECT_LE(relativeError(ratio, 0.4), byPrecision(1e-15, 3e-7));
}

TEST(ImpactFriction, NeverAddsEnergyAtAnImpact)
{
    TRACES("R8", "LC2", "DD15");
    for (int i = 0; i < 64; ++i) {
        World world(weightless());
        const Body rod = addBox(world, {0, 2}, 1.5, 0.3,
                                {.velocity = vec(i % 8 - 4, -3),
                                 .spin = i / 8 - 4.0,
                                 .angle = 0.1 * i,
                                 .friction = 0.5,
                                 .restitution = 1});
        addGround(world, 0, 1000, {.friction = 0.5});
        const double before = rod.energy().kinetic();
        runSeconds(world, 3);
        EXPECT_LE(rod.energy().kinetic(), before * (1 + kExact)) << i;
    }
}

}  // namespace
}  // namespace tamias2d::test
