// SPDX-License-Identifier: MIT
// Hits of impacts that the passes stop, all that touch at once: in crowds.
#include <support/build.hpp>
#include <support/impacts.hpp>
#include <support/run.hpp>
#include <support/scenes.hpp>
#include <support/traces.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

namespace tamias2d::test {
namespace {

constexpr int kTicks = 8;   // a step of runSeconds

// What has been hit, by the body that came down on it.
std::map<BodyId, std::vector<HitEvent>> hitsOn(World& world, const std::vector<Body>& bodies, double seconds)
{
    std::map<BodyId, std::vector<HitEvent>> hits;
    runSeconds(world, seconds, 60, 4, [&] {
        for (const HitEvent& hit : world.events().hits)
            for (const Body& body : bodies)
                if (hit.bodyA == body.id() || hit.bodyB == body.id()) hits[body.id()].push_back(hit);
    });
    return hits;
}

// A bed of boxes side by side, near enough to be a crowd, on the ground.
void addBed(World& world, int count)
{
    const double gap = restGapFor(world, 1);
    addGround(world);
    for (int i = 0; i < count; ++i) addBox(world, {i * (1 + gap), 0.5 + gap}, 1, 1);
}

// A body that falls by h comes with sqrt(2 g h), after sqrt(2 h / g): twice, at the two points of its side.
TEST(CrowdHits, EveryCrateThatLandsInACrowdTellsItOnceWithItsSpeed)
{
    TRACES("R7", "R8", "DD10", "ADR13", "ADR21");
    constexpr int kCount = 12;
    World world;
    addBed(world, kCount);
    runSeconds(world, 1);
    const double gap = restGapFor(world, 0.8), start = world.time();
    std::vector<Body> crates;
    std::vector<double> heights;
    for (int i = 0; i < kCount; ++i) {
        heights.push_back(0.02 + 0.0611 * i);
        const double floor = 1 + restGapFor(world, 1) + gap;
        crates.push_back(
            addBox(world, {i * (1 + restGapFor(world, 1)), floor + heights.back() + 0.4}, 0.8, 0.8));
    }
    auto hits = hitsOn(world, crates, 2);
    for (std::size_t i = 0; i < crates.size(); ++i) {
        SCOPED_TRACE(testing::Message() << heights[i] << " m");
        const std::vector<HitEvent>& of = hits[crates[i].id()];
        const double speed = std::sqrt(2 * kGravity * heights[i]);
        ASSERT_EQ(of.size(), 2u) << "one for each point of its side";
        EXPECT_EQ(of[0].group, of[1].group);
        for (const HitEvent& hit : of) {
            EXPECT_TRUE(hit.simultaneous);
            EXPECT_EQ(hit.restitution, 0);
            EXPECT_NEAR(hit.approachSpeed, speed, 0.005 * speed + 0.01);
            EXPECT_NEAR(hit.time - start, std::sqrt(2 * heights[i] / kGravity), 0.001);
            EXPECT_NEAR(std::abs(hit.normal.y), 1, 1e-3);
            EXPECT_NEAR(hit.point.y, 1, 0.01);
        }
    }
}

// The passes bring a body to its rest gap with the end of the tick. One that comes with v and meets it t
// after the start of the tick gets m v (1 - t/h): all that stops it if it is there at the start.
TEST(CrowdHits, TheirImpulsesAreThoseThatStopBodies)
{
    TRACES("R7", "R8", "DD10", "T2", "ADR21");
    const double speed = 2, size = 0.5;
    World world(weightless());
    const double gap = restGapFor(world, size);
    addBox(world, {0, 0}, 2, 20, {.type = BodyType::Static});
    std::vector<Body> boxes;
    for (int i = 0; i < 10; ++i)
        boxes.push_back(addBox(world, {-2 - 0.0007 * i, (i - 4.5) * (size + 1.5 * gap)}, size, size,
                               {.velocity = vec(speed, 0), .friction = 0}));
    const double mass = static_cast<double>(boxes[0].mass());
    const double tick = 1.0 / 60 / kTicks;
    const double before = world.momentum().linear.x;
    const auto hits = hitsOn(world, boxes, 1);
    ASSERT_EQ(hits.size(), boxes.size());
    double whole = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        SCOPED_TRACE(i);
        double impulse = 0;
        for (const HitEvent& hit : hits.at(boxes[i].id())) {
            EXPECT_TRUE(hit.simultaneous);
            EXPECT_NEAR(hit.approachSpeed, speed, 1e-4);
            impulse += static_cast<double>(hit.normalImpulse);
        }
        const double met = (1 + 0.0007 * static_cast<double>(i) - size / 2 - gap) / speed;
        const double time = hits.at(boxes[i].id())[0].time;
        EXPECT_NEAR(time, met, 1e-5);
        const double part = 1 - (time / tick - std::floor(time / tick));
        EXPECT_NEAR(impulse, part * mass * speed, 1e-3 * mass * speed);
        whole += impulse / part;
    }
    EXPECT_NEAR(whole, before, 0.01 * before);
    EXPECT_NEAR(world.momentum().linear.x, 0, 0.01 * before);
}

// Each contact changed the momenta by what it says: in a tick without gravity, of a body that touches nothing
// else, by no other.
TEST(CrowdHits, AgreeWithTheImpulsesOfTheirContacts)
{
    TRACES("R7", "R8", "DD10", "ADR21");
    World world;
    addBed(world, 10);
    std::vector<Body> crates;
    for (int i = 0; i < 10; ++i)
        crates.push_back(addBox(world, {1.001 * i, 1.5 + 0.05 * i}, 0.6, 0.6, {.velocity = vec(0.5, 0)}));
    std::size_t compared = 0;
    runSeconds(world, 1, 60, 1, [&] {
        for (const HitEvent& hit : world.events().hits) {
            EXPECT_GT(hit.normalImpulse, 0);
            EXPECT_LE(std::abs(hit.tangentImpulse), toReal(0.6) * hit.normalImpulse * toReal(1.0001));
            const DVec2 vA =
                toDVec2(hit.velocityA) + cross(static_cast<double>(hit.angularVelocityA), toDVec2(hit.armA));
            const DVec2 vB =
                toDVec2(hit.velocityB) + cross(static_cast<double>(hit.angularVelocityB), toDVec2(hit.armB));
            EXPECT_NEAR(static_cast<double>(hit.approachSpeed), -dot(toDVec2(hit.normal), vB - vA), 1e-5);
            for (const ContactView& contact : world.contacts()) {
                if (contact.shapeA != hit.shapeA || contact.shapeB != hit.shapeB) continue;
                double most = 0;
                for (int k = 0; k < contact.pointCount; ++k)
                    most += static_cast<double>(contact.points[static_cast<std::size_t>(k)].normalImpulse);
                EXPECT_LE(static_cast<double>(hit.normalImpulse), most * (1 + 1e-5));
                ++compared;
            }
        }
    });
    EXPECT_GE(compared, 20u);
}

// Those that the passes stop.
std::size_t hitsWithin(World& world, double seconds)
{
    std::size_t hits = 0;
    runSeconds(world, seconds, 60, 4, [&] {
        for (const HitEvent& hit : world.events().hits) hits += hit.simultaneous ? 1 : 0;
    });
    return hits;
}

TEST(CrowdHits, NoneComesFromAHeapAtRest)
{
    TRACES("R7", "R8", "T1", "ADR21");
    for (const std::uint32_t seed : {1u, 3u, 7u}) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        World world({.allowSleep = false});
        addBin(world, {});
        addHail(world, 100, true, seed, {});
        EXPECT_GT(hitsWithin(world, 5), 100u) << "it fell";
        for (int still = 0; still < 60 && world.time() < 60;) {
            world.step();
            still = fastestBody(world) < 0.005 ? still + 1 : 0;
        }
        EXPECT_EQ(hitsWithin(world, 5), 0u);
        EXPECT_LT(world.time(), 60);
        EXPECT_GE(world.lastReport().touching, 100u);
    }
}

TEST(CrowdHits, NoneComesFromABlockThatDriftsOrIsCarried)
{
    TRACES("R7", "R8", "ADR21");
    World world(weightless());
    for (int i = 0; i < 64; ++i)
        addBox(world, {1.001 * (i % 8), 1.001 * (i / 8)}, 1, 1, {.velocity = vec(3, 1)});
    EXPECT_EQ(hitsWithin(world, 3), 0u);

    World lift({.allowSleep = false});
    Body floor = addBox(lift, {0, -0.5}, 20, 1, {.type = BodyType::Kinematic});
    addPyramid(lift, 6);
    runSeconds(lift, 1);
    floor.setLinearVelocity(vec(0, 0.01));
    runSeconds(lift, 1);
    EXPECT_EQ(hitsWithin(lift, 2), 0u) << "on a floor that rises";
}

// Who is a crowd decides how an approach is stopped, not what is told of it.
TEST(CrowdHits, AreThoseThatBodiesMakeWhichAreNoCrowd)
{
    TRACES("R7", "R8", "ADR13", "ADR21");
    const auto fall = [](int crowd) {
        WorldDef def;
        def.tuning.crowd = crowd;
        World world(def);
        addBed(world, 12);
        std::vector<Body> crates;
        for (int i = 0; i < 12; ++i)
            crates.push_back(addBox(world, {1.001 * i, 1.62 + 0.04 * i}, 0.8, 0.8, {.angle = 0.05 * i}));
        const auto hits = hitsOn(world, crates, 1);
        std::vector<HitEvent> firsts;
        for (const Body& crate : crates) firsts.push_back(hits.at(crate.id()).front());
        return firsts;
    };
    const std::vector<HitEvent> alone = fall(1000000), crowd = fall(8);
    const double shaken =
        2 * kGravity / 60 / kTicks;  // the bed, by the neighbors: two ticks of its weight   [m/s]
    for (std::size_t i = 0; i < alone.size(); ++i) {
        SCOPED_TRACE(i);
        EXPECT_FALSE(alone[i].simultaneous);
        EXPECT_TRUE(crowd[i].simultaneous);
        EXPECT_NEAR(alone[i].time, crowd[i].time, 1e-4);
        EXPECT_NEAR(alone[i].approachSpeed, crowd[i].approachSpeed, shaken);
        EXPECT_LE(length(alone[i].normal - crowd[i].normal), 0.01);
        EXPECT_LE(length(alone[i].point - crowd[i].point), 0.01);
    }
}

TEST(CrowdHits, AreNotCountedAsImpulsesAtTheirTime)
{
    TRACES("R7", "R8");
    World world;
    addBed(world, 10);
    addBox(world, {4, 2}, 0.8, 0.8);
    runSeconds(world, 1, 60, 4, [&] {
        const auto hits = world.events().hits;
        const auto together =
            std::count_if(hits.begin(), hits.end(), [](const HitEvent& hit) { return hit.simultaneous; });
        EXPECT_EQ(world.lastReport().impacts, hits.size() - static_cast<std::size_t>(together));
    });
}

// All figures of all hits, bit by bit.
std::vector<std::uint64_t> bitsOfHits(LaneWidth lanes, int threads)
{
    World world({.lanes = lanes, .threads = threads});
    addBin(world, {});
    addHail(world, 80, true, 3, {.restitution = toReal(0.2)});
    std::vector<std::uint64_t> bits;
    const auto add = [&bits](real x) { bits.push_back(std::bit_cast<std::uint64_t>(double(x))); };
    const auto addVec = [&add](Vec2 v) { add(v.x), add(v.y); };
    for (int i = 0; i < 150; ++i) {
        world.step();
        for (const HitEvent& hit : world.events().hits) {
            bits.push_back(hit.group * 2 + (hit.simultaneous ? 1 : 0));
            for (const double x : {hit.time, hit.point.x, hit.point.y})
                bits.push_back(std::bit_cast<std::uint64_t>(x));
            for (const Vec2 v : {hit.normal, hit.armA, hit.armB, hit.velocityA, hit.velocityB}) addVec(v);
            for (const real x : {hit.approachSpeed, hit.normalImpulse, hit.tangentImpulse,
                                 hit.angularVelocityA, hit.angularVelocityB})
                add(x);
        }
    }
    return bits;
}

TEST(CrowdHits, AreTheSameWithEveryWidthAndOnThreads)
{
    TRACES("ADR5", "ADR6", "ADR26", "R7");
    const std::vector<std::uint64_t> expected = bitsOfHits(LaneWidth::Best, 1);
    EXPECT_GT(expected.size(), 1000u);
    EXPECT_EQ(bitsOfHits(LaneWidth::Best, 3), expected) << "threads";
    for (const LaneWidth lanes :
         {LaneWidth::Scalar, LaneWidth::Bytes16, LaneWidth::Bytes32, LaneWidth::Bytes64}) {
        if (!hasLanes(lanes)) continue;
        EXPECT_TRUE(bitsOfHits(lanes, 1) == expected) << "width " << static_cast<int>(lanes);
    }
}

}  // namespace
}  // namespace tamias2d::test
