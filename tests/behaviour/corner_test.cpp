// SPDX-License-Identifier: MIT
// What rests between two supports, of which one may bear nothing, makes no impacts; and what comes slowly
// still does. Without sleep, which would hide both.
#include <support/build.hpp>
#include <support/run.hpp>
#include <support/traces.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace tamias2d::test {
namespace {

constexpr double kRestitutionsAtRest[] = {0, 0.5, 1};
constexpr double kSettled = 5;   // it comes to rest before   [s]
constexpr double kListens = 5;   // [s]

struct Room {
    World world;
    double gap;     // the rest gap of a body of 1 m
    Options body;   // of all that is in it

    explicit Room(double restitution, double friction = 0.6, Vec2 gravity = vec(0, -kGravity))
        : world(withoutSleep(gravity)), gap(restGapFor(world, 1)),
          body{.friction = friction, .restitution = restitution}
    {
    }

    static WorldDef withoutSleep(Vec2 gravity)
    {
        WorldDef def;
        def.gravity = gravity;
        def.allowSleep = false;
        return def;
    }
    Options still(double angle = 0) const
    {
        return {.type = BodyType::Static, .angle = angle, .friction = body.friction};
    }
    void addFloor() { addBox(world, {0, -0.5}, 40, 1, still()); }
    void addLeftWall(double x) { addBox(world, {x - 0.5, 5}, 1, 12, still()); }
    void addRightWall(double x) { addBox(world, {x + 0.5, 5}, 1, 12, still()); }
    // A floor that rises to the right from the origin, or to the left, by `angle`.
    void addSlope(double side, double angle)
    {
        const double c = std::cos(angle), s = std::sin(angle);
        addBox(world, {side * (5 * c + 0.5 * s), 5 * s - 0.5 * c}, 10, 1, still(side * angle));
    }

    void expectSilence(double settled = kSettled)
    {
        runSeconds(world, settled);
        std::size_t hits = 0;
        const RunTotals totals =
            runSeconds(world, kListens, 60, 4, [&] { hits += world.events().hits.size(); });
        EXPECT_EQ(totals.impacts, 0u) << "C_R " << body.restitution << ", mu " << body.friction;
        EXPECT_EQ(hits, 0u) << "C_R " << body.restitution << ", mu " << body.friction;
    }
};

// Puts one body of each kind into the corner of a floor and a wall on its left, `drop` beyond the rest gap.
void expectSilenceInTheCorner(double restitution, double friction, Vec2 gravity, double drop)
{
    using Add = void (*)(Room&, double);
    const Add add[] = {
        [](Room& room, double off) { addDisc(room.world, {0.5 + off, 0.5 + off}, 0.5, room.body); },
        [](Room& room, double off) { addBox(room.world, {0.5 + off, 0.5 + off}, 1, 1, room.body); },
        [](Room& room, double off) { addCapsule(room.world, {1 + off, 0.5 + off}, 2, 0.5, room.body); },
    };
    for (std::size_t kind = 0; kind < std::size(add); ++kind) {
        SCOPED_TRACE(testing::Message() << "kind " << kind << ", gravity along x " << gravity.x);
        Room room(restitution, friction, gravity);
        room.addFloor();
        room.addLeftWall(0);
        add[kind](room, room.gap + drop);
        room.expectSilence();
    }
}

TEST(Corner, OfAFloorAndAWallIsSilentAroundWhatRestsInIt)
{
    TRACES("R7", "R8", "ADR7", "ADR13");
    for (const double e : kRestitutionsAtRest) {
        for (const double friction : {0.0, 0.6}) {
            for (const Vec2 gravity : {vec(0, -kGravity), vec(-kGravity, -kGravity)}) {
                expectSilenceInTheCorner(e, friction, gravity, 0);
                if (e < 1) expectSilenceInTheCorner(e, friction, gravity, 0.05);
            }
        }
    }
}

// Room to spare beside the two rest gaps, or less than the two: they are squeezed.
TEST(Corner, OfASnugSlotIsSilentAroundADiscAndABox)
{
    TRACES("R7", "R8", "ADR7");
    for (const double e : kRestitutionsAtRest) {
        for (const double friction : {0.0, 0.6}) {
            for (const double spare : {0.01, 0.0, -0.0005, -0.001}) {
                for (const bool round : {false, true}) {
                    SCOPED_TRACE(testing::Message() << "room " << spare << (round ? ", disc" : ", box"));
                    Room room(e, friction);
                    const double width = 1 + 2 * room.gap + spare;
                    room.addFloor();
                    room.addLeftWall(-width / 2);
                    room.addRightWall(width / 2);
                    const Position place{0, 0.5 + room.gap};
                    if (round)
                        addDisc(room.world, place, 0.5, room.body);
                    else
                        addBox(room.world, place, 1, 1, room.body);
                    room.expectSilence();
                }
            }
        }
    }
}

// Nothing but the two walls acts on it, by turns.
TEST(Corner, OfTwoWallsIsSilentAroundABoxWedgedInWithoutForces)
{
    TRACES("R7", "R8", "ADR7");
    for (const double e : {0.3, 0.5, 0.9}) {
        for (const double friction : {0.3, 0.6}) {
            Room room(e, friction, {});
            room.addLeftWall(0);
            room.addRightWall(1 + room.gap);   // a rest gap less than it takes
            room.body.velocity = vec(0.1, 0);
            addBox(room.world, {0.5 + room.gap / 2, 0.5}, 1, 1, room.body);
            room.expectSilence();
        }
    }
}

TEST(Corner, OfTwoSlopesIsSilentAroundADisc)
{
    TRACES("R7", "R8", "ADR7");
    for (const double e : kRestitutionsAtRest) {
        for (const double friction : {0.0, 0.6}) {
            for (const double degrees : {20.0, 45.0, 70.0}) {
                SCOPED_TRACE(testing::Message() << degrees << " degrees");
                Room room(e, friction);
                const double angle = degrees * kPi / 180;
                room.addSlope(1, angle);
                room.addSlope(-1, angle);
                addDisc(room.world, {0, (0.5 + room.gap) / std::cos(angle)}, 0.5, room.body);
                room.expectSilence();
            }
        }
    }
}

TEST(Corner, OfATroughIsSilentAroundTwoDiscsSideBySide)
{
    TRACES("R7", "R8", "ADR7");
    for (const double e : {0.0, 0.5}) {
        for (const double friction : {0.0, 0.6}) {
            for (const double width : {2.5, 1.8}) {
                SCOPED_TRACE(testing::Message() << width << " m wide");
                Room room(e, friction);
                room.addFloor();
                room.addLeftWall(0);
                room.addRightWall(width);
                addDisc(room.world, {0.51, 0.55}, 0.5, room.body);
                addDisc(room.world, {width - 0.51, width > 2 ? 0.6 : 1.3}, 0.5, room.body);
                room.expectSilence();
            }
        }
    }
}

TEST(Corner, OfABoxIsSilentAroundTwentyDiscsAtRest)
{
    TRACES("R7", "R8", "ADR7");
    for (const double e : {0.0, 0.5}) {
        Room room(e);
        room.addFloor();
        room.addLeftWall(0);
        room.addRightWall(5);
        for (int i = 0; i < 20; ++i) {
            const int row = i / 4;
            addDisc(room.world, {0.6 + 1.1 * (i % 4) + 0.13 * (row % 2), 0.6 + 1.1 * row},
                    0.45 + 0.002 * (i % 5), room.body);
        }
        room.expectSilence(10);
    }
}

// What comes by a thousandth of its width in a second bounces, on a floor as well.
TEST(Corner, LetsWhatComesSlowlyBounce)
{
    TRACES("R8", "DD12", "ADR7");
    for (const double e : {0.5, 1.0}) {
        for (const double speed : {0.001, 0.01}) {
            for (const Vec2 gravity : {vec(0, -kGravity), Vec2{}}) {
                SCOPED_TRACE(testing::Message() << speed << " m/s, gravity " << gravity.y);
                Room room(e, 0, gravity);
                if (gravity.y < 0) room.addFloor();
                room.addRightWall(0);
                room.body.velocity = vec(speed, 0);
                const double ahead = speed / 4;
                const Body disc =
                    addDisc(room.world, {-0.5 - room.gap - ahead, 0.5 + room.gap}, 0.5, room.body);
                runSeconds(room.world, 0.5);
                EXPECT_NEAR(velocityOf(disc).x, -e * speed, 1e-3 * speed);
            }
        }
    }
}

}  // namespace
}  // namespace tamias2d::test
