// SPDX-License-Identifier: MIT
// Impacts of two bodies, against DD8: velocities, and the point where they meet.
#include <support/build.hpp>
#include <support/impacts.hpp>
#include <support/overlap.hpp>
#include <support/random.hpp>
#include <support/run.hpp>
#include <support/traces.hpp>

#include <cmath>

namespace tamias2d::test {
namespace {

constexpr double kRestitutions[] = {0, 0.3, 0.8, 1};

// A body of an impact: its outline, and how it flies until then.
struct Flyer {
    Body body;
    Outline outline;
    DVec2 place, velocity;
    double angle = 0, spin = 0, started = 0;

    Flyer(const World& world, const Body& b)
        : body(b), outline(outlineOf(b.shapes()[0].definition().geometry)), place(centerOf(b)),
          velocity(velocityOf(b)), angle(b.angle()), spin(spinOf(b)), started(world.time())
    {
    }

    Outline at(double time) const
    {
        Outline out;
        tamias2d::test::place(outline, place + (time - started) * velocity, angle + (time - started) * spin,
                              out);
        return out;
    }
};

enum class Meeting {
    Missed,   // they flew past each other
    Free,     // after the impact nothing acted until the end of the step
    Pressed,  // a plastic impact leaves them in contact, which goes on pressing as they turn
};

// Steps until the two have met and compares what then happened with DD8.
Meeting meet(World& world, Body first, Body second, double restGap, double friction = 0)
{
    for (int i = 0; i < 120; ++i) {
        const Flyer a(world, first), b(world, second);
        Movers movers = moversOf(world);
        const double scale = length(a.velocity) + length(b.velocity) + std::abs(a.spin) + std::abs(b.spin);
        world.step();
        if (world.events().hits.empty()) continue;

        const std::vector<HitEvent> impact = impactsOf(world)[0];
        for (const HitEvent& hit : impact) {
            const Outline left = a.at(hit.time), right = b.at(hit.time);
            const double gap = gapBetween(left, right);
            EXPECT_LE(std::abs(gap - restGap), restGap) << "gap " << gap / restGap << " rest gaps";
            const DVec2 point = hit.point - Position{};
            if (impact.size() == 1) {
                EXPECT_LE(length(point - nearestPoint(left, right)), 2 * restGap)
                    << length(point - nearestPoint(left, right)) / restGap << " rest gaps off";
            }
            EXPECT_GT(hit.time, a.started - 1e-12);
            EXPECT_LE(hit.time, world.time() + 1e-12);
            const Flyer& sideA = hit.bodyA == first.id() ? a : b;
            const DVec2 center = sideA.place + (hit.time - a.started) * sideA.velocity;
            EXPECT_LE(length(center + toDVec2(hit.armA) - point), 2 * restGap);
        }
        const double pressing = pressingOf(world), blow = static_cast<double>(impact[0].normalImpulse);
        const bool pressed = pressing > byPrecision(1e-12, 1e-6) * blow;
        // Floats cannot say exactly how two points close together share an impulse.
        const double condition = conditionOf(impact, movers.at(impact[0].bodyA), movers.at(impact[0].bodyB));
        const double tolerance = kExact * byPrecision(1, condition);
        applyHits(world, movers, tolerance, friction, !pressed);
        if (!pressed) {
            expectVelocities(world, movers, tolerance, scale);
            return Meeting::Free;
        }
        EXPECT_EQ(impact[0].restitution, 0) << "pressed with " << pressing << " after " << blow;
        return Meeting::Pressed;
    }
    return Meeting::Missed;
}

// Two random bodies that fly at each other, turning: how many of `tries` met and were then free.
template <class MakeA, class MakeB>
int meetings(int tries, double restitution, double friction, double size, MakeA&& makeA, MakeB&& makeB)
{
    int met = 0;
    for (int seed = 1; seed <= tries; ++seed) {
        Random random(static_cast<std::uint32_t>(seed));
        World world(weightless());
        const auto options = [&](double direction) {
            const double ahead = random.between(1, 6), aside = random.between(-1, 1);
            return Options{.velocity = vec(direction * ahead, aside),
                           .spin = random.between(-4, 4),
                           .angle = random.between(0, kTwoPi),
                           .density = random.between(0.5, 3),
                           .friction = friction,
                           .restitution = restitution};
        };
        const double heightA = random.between(-0.4, 0.4), heightB = random.between(-0.4, 0.4);
        const Options optionsA = options(1), optionsB = options(-1);
        const Body a = makeA(world, Position{-2, heightA}, optionsA);
        const Body b = makeB(world, Position{2, heightB}, optionsB);
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", C_R " << restitution);
        met += meet(world, a, b, restGapFor(world, size), friction) == Meeting::Free;
    }
    return met;
}

const auto makeWideBox = [](World& w, Position p, const Options& o) { return addBox(w, p, 1.2, 0.8, o); };
const auto makeTallBox = [](World& w, Position p, const Options& o) { return addBox(w, p, 0.9, 1.5, o); };
const auto makeDisc = [](World& w, Position p, const Options& o) { return addDisc(w, p, 0.45, o); };
const auto makeHexagon = [](World& w, Position p, const Options& o) { return addRegular(w, p, 6, 0.6, o); };

TEST(Impact, OfACornerOnAnEdgeObeysDD8)
{
    TRACES("R3", "R7", "R8", "IM3", "DD8", "DD9", "DD11", "DD12", "DD14", "GS1", "GS2", "A5", "ADR7");
    for (const double e : kRestitutions) {
        EXPECT_GE(meetings(50, e, 0, 0.8, makeWideBox, makeTallBox), e > 0 ? 40 : 10) << "C_R " << e;
    }
}

TEST(Impact, OfADiscOnABoxObeysDD8)
{
    TRACES("R3", "R8", "IM3", "DD8", "DD9", "DD11", "DD12");
    for (const double e : kRestitutions) {
        EXPECT_GE(meetings(50, e, 0, 0.8, makeDisc, makeWideBox), e > 0 ? 35 : 10) << "C_R " << e;
    }
}

TEST(Impact, OfTwoDiscsObeysDD8)
{
    TRACES("R3", "R8", "IM3", "DD8", "DD12");
    for (const double e : kRestitutions) {
        EXPECT_GE(meetings(50, e, 0, 0.9, makeDisc, makeDisc), e > 0 ? 35 : 10) << "C_R " << e;
    }
}

TEST(Impact, OfPolygonsWithFrictionObeysDD8AndCoulomb)
{
    TRACES("R3", "R8", "IM3", "DD8", "DD12", "LC2");
    for (const double friction : {0.05, 0.6}) {
        for (const double e : kRestitutions) {
            EXPECT_GE(meetings(50, e, friction, 0.9, makeHexagon, makeTallBox), e > 0 ? 40 : 10)
                << "C_R " << e;
        }
    }
}

TEST(Impact, OfANearlyFlushCornerIsOnePoint)
{
    TRACES("R8", "IM3", "DD8");
    for (const double e : kRestitutions) {
        World world(weightless());
        const Body a = addBox(world, {-1, 0.2}, 1, 1,
                              {.velocity = vec(3, 0.5), .angle = 0.02, .friction = 0, .restitution = e});
        const Body b = addBox(world, {1, -0.2}, 1, 1.5, {.velocity = vec(-2, 0), .friction = 0});
        SCOPED_TRACE(e);
        EXPECT_NE(meet(world, a, b, restGapFor(world, 1)), Meeting::Missed);
        EXPECT_EQ(impactsOf(world)[0].size(), 1u);
    }
}

TEST(Impact, OfACornerOnACornerObeysDD8)
{
    TRACES("R8", "IM3", "DD8", "LC1");
    for (const double e : kRestitutions) {
        for (const double aside : {0.0, 0.01, -0.1}) {
            World world(weightless());
            const Options common{.angle = kPi / 4, .friction = 0, .restitution = e};
            Options left = common, right = common;
            left.velocity = vec(3, 0);
            right.velocity = vec(-2, 0);
            const Body a = addBox(world, {-2, aside}, 1, 1, left), b = addBox(world, {2, 0}, 1, 1, right);
            SCOPED_TRACE(testing::Message() << "C_R " << e << ", aside " << aside);
            EXPECT_NE(meet(world, a, b, restGapFor(world, 1)), Meeting::Missed);
        }
    }
}

TEST(Impact, OfABodyOnAKinematicOneTakesItsMassAsInfinite)
{
    TRACES("R8", "IM3", "DD8");
    for (const double e : kRestitutions) {
        World world(weightless());
        const Body a =
            addBox(world, {-1, 0.2}, 1, 0.8,
                   {.velocity = vec(3, 0.5), .spin = 2, .angle = 0.5, .friction = 0, .restitution = e});
        const Body b =
            addBox(world, {1, 0}, 0.8, 3,
                   {.type = BodyType::Kinematic, .velocity = vec(-2, 0), .spin = 1, .friction = 0});
        SCOPED_TRACE(e);
        EXPECT_NE(meet(world, a, b, restGapFor(world, 0.8)), Meeting::Missed);
        EXPECT_EQ(b.linearVelocity(), vec(-2, 0));
        EXPECT_EQ(b.angularVelocity(), 1);
    }
}

// Two boxes whose facing edges stay parallel: both turn at the same rate and are in line.
void expectFlushImpact(double restitution, double spin, double offset)
{
    World world(weightless());
    const double angle = -spin * 0.2;
    const DVec2 x{std::cos(angle), std::sin(angle)}, y{-x.y, x.x};
    const DVec2 placeA = -1.0 * x + offset * y, placeB = 1.0 * x;
    const Options common{.spin = spin, .angle = angle, .friction = 0, .restitution = restitution};
    Options left = common, right = common;
    left.velocity = toVec2(2.0 * x);
    right.velocity = toVec2(-3.0 * x + 0.25 * y);
    right.density = 2;
    const Body a = addBox(world, {placeA.x, placeA.y}, 1, 1, left);
    const Body b = addBox(world, {placeB.x, placeB.y}, 1, 1.5, right);
    const Flyer flyerA(world, a), flyerB(world, b);
    ASSERT_NE(meet(world, a, b, restGapFor(world, 1)), Meeting::Missed);

    const std::vector<HitEvent> impact = impactsOf(world)[0];
    ASSERT_EQ(impact.size(), 2u);
    const Outline boxA = flyerA.at(impact[0].time), boxB = flyerB.at(impact[0].time);
    // The overlap of the two edges ends where a corner of one lies on the other.
    for (const HitEvent& hit : impact) {
        double nearest = 1;
        for (const Outline* box : {&boxA, &boxB}) {
            for (const DVec2 corner : box->core)
                nearest = std::min(nearest, length(corner - (hit.point - Position{})));
        }
        EXPECT_LE(nearest, 2 * restGapFor(world, 1));
    }
    EXPECT_GT(length(impact[0].point - impact[1].point), 0.5);
}

TEST(Impact, OfFlushEdgesActsAtBothEndsAtOnce)
{
    TRACES("R8", "IM3", "DD8", "DD12", "LC1");
    for (const double e : kRestitutions) {
        for (const double offset : {0.0, 0.3, -0.6}) {
            SCOPED_TRACE(testing::Message() << "C_R " << e << ", offset " << offset);
            expectFlushImpact(e, 0, offset);
        }
    }
}

TEST(Impact, OfFlushEdgesThatTurnTogetherActsAtBothEnds)
{
    TRACES("R8", "IM3", "DD8", "DD12");
    for (const double e : kRestitutions) {
        SCOPED_TRACE(testing::Message() << "C_R " << e);
        expectFlushImpact(e, 0.5, 0.3);
    }
}

TEST(Impact, HeadOnGivesTheSchoolbookSpeeds)
{
    TRACES("R8", "IM3", "GD1", "DD12");
    for (const double e : kRestitutions) {
        World world(weightless());
        const Options common{.friction = 0, .restitution = e};
        Options left = common, right = common;
        left.velocity = vec(3, 0);
        right.velocity = vec(-1, 0);
        right.density = 2;
        const Body a = addDisc(world, {-1, 0}, 0.5, left), b = addDisc(world, {1, 0}, 0.5, right);
        runSeconds(world, 1);
        const double common2 = (3 - 2) / 3.0;  // speed of the common center
        EXPECT_LE(length(velocityOf(a) - DVec2{common2 - e * 4 * 2 / 3, 0}), 4 * kExact) << e;
        EXPECT_LE(length(velocityOf(b) - DVec2{common2 + e * 4 / 3, 0}), 4 * kExact) << e;
    }
}

TEST(Impact, RestitutionOfAPairIsTheLargerUnlessMixedOtherwise)
{
    TRACES("R3", "DD12");
    const auto apart = [](MixingRule rule) {
        World world(weightless());
        world.setMixingRules(MixingRule::GeometricMean, rule);
        const Body a = addDisc(world, {-1, 0}, 0.5, {.velocity = vec(1, 0), .restitution = 0.25});
        const Body b = addDisc(world, {1, 0}, 0.5, {.velocity = vec(-1, 0), .restitution = 0.75});
        runSeconds(world, 2);
        return (velocityOf(b).x - velocityOf(a).x) / 2;
    };
    EXPECT_NEAR(apart(MixingRule::Maximum), 0.75, kExact);
    EXPECT_NEAR(apart(MixingRule::Minimum), 0.25, kExact);
    EXPECT_NEAR(apart(MixingRule::Average), 0.5, kExact);
    EXPECT_NEAR(apart(MixingRule::Multiply), 0.1875, kExact);
    EXPECT_NEAR(apart(MixingRule::GeometricMean), std::sqrt(0.1875), kExact);
}

TEST(Impact, ALockedBodyTakesItButDoesNotTurn)
{
    TRACES("R8", "DD8", "LC3");
    World world(weightless());
    Body a = addBox(world, {-1, 0.3}, 1, 1, {.velocity = vec(2, 0), .friction = 0, .restitution = 1});
    a.setLocks(false, false, true);
    const Body wall = addBox(world, {1, 0}, 1, 1, {.type = BodyType::Static, .angle = 0.5, .friction = 0});
    runSeconds(world, 2);
    EXPECT_EQ(a.angularVelocity(), 0);
    EXPECT_LE(relativeError(length(velocityOf(a)), 2), kExact);
    EXPECT_LT(velocityOf(a).x, 0);
    EXPECT_EQ(wall.position(), (Position{1, 0}));
}

}  // namespace
}  // namespace tamias2d::test
