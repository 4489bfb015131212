// SPDX-License-Identifier: MIT
// Bodies that glide and roll over floors made of many pieces. A seam between flush pieces is no obstacle; a
// step, however low, is one, and is hit as two rigid bodies hit.
#include <support/run.hpp>
#include <support/scenes.hpp>

namespace tamias2d::test {
namespace {

constexpr double kSpeedKept = 1e-3;  // of the speed
constexpr double kHop = 1e-3;        // [m]

// What goes over the floor. Its width is 1 m, and it is put down at the rest gap.
struct Rider {
    const char* name;
    Body (*add)(World&, Position, const Options&);
    double height;  // of the center over the lowest point   [m]
    double size;    // smallest width                        [m]
    bool rolls = false;
};

const Rider kRiders[] = {
    {"box", [](World& w, Position p, const Options& o) { return addBox(w, p, 1, 1, o); }, 0.5, 1},
    {"rounded box",
     [](World& w, Position p, const Options& o) {
         Options rounded = o;
         rounded.rounding = 0.1;
         return addBox(w, p, 1, 1, rounded);
     },
     0.5, 1},
    {"capsule", [](World& w, Position p, const Options& o) { return addCapsule(w, p, 1, 0.25, o); }, 0.25,
     0.5},
    {"circle", [](World& w, Position p, const Options& o) { return addDisc(w, p, 0.5, o); }, 0.5, 1},
    {"hexagon", [](World& w, Position p, const Options& o) { return addRegular(w, p, 6, 0.5, o); },
     0.43301270189221932, 0.86602540378443865},
    {"rolling disc", [](World& w, Position p, const Options& o) { return addDisc(w, p, 0.5, o); }, 0.5, 1,
     true},
};

Body putDown(World& world, const Rider& rider, double speed, double x = 2)
{
    const double rest = rider.height + restGapFor(world, rider.size);
    return rider.add(world, {x, rest},
                     {.velocity = vec(speed, 0),
                      .spin = rider.rolls ? -speed / rider.height : 0,
                      .friction = rider.rolls ? 0.6 : 0});
}

// What the way from x = 2 to x = 197 did to a rider.
struct Ride {
    double speedError = 0;  // worst on the way, of the speed
    double hop = 0;         // [m]
    double reached = 0;     // x at the end   [m]
};

Ride rideOver(const Tiles& floor, const Rider& rider, double speed)
{
    World world;
    addTiles(world, floor);
    const Body body = putDown(world, rider, speed);
    const double startHeight = body.position().y;
    Ride ride;
    const int steps = static_cast<int>(195 / speed * 60) + 30;
    for (int i = 0; i < steps && body.position().x < 197; ++i) {
        world.step();
        ride.speedError = std::max(ride.speedError, std::abs(velocityOf(body).x / speed - 1));
        ride.hop = std::max(ride.hop, body.position().y - startHeight);
    }
    ride.reached = body.position().x;
    return ride;
}

void expectSmoothRides(Tiles floor)
{
    double worstSpeed = 0, worstHop = 0;
    for (const Rider& rider : kRiders) {
        for (const double speed : {5.0, 20.0}) {
            for (const bool oneBody : {false, true}) {
                floor.oneBody = oneBody;
                floor.friction = rider.rolls ? 0.6 : 0;
                const Ride ride = rideOver(floor, rider, speed);
                const std::string what = std::string(rider.name) + " at " + std::to_string(int(speed)) +
                                         " m/s, " + (oneBody ? "one body" : "a body each");
                EXPECT_LE(ride.speedError, kSpeedKept) << what;
                EXPECT_LE(ride.hop, kHop) << what;
                EXPECT_GE(ride.reached, 197) << what;
                worstSpeed = std::max(worstSpeed, ride.speedError);
                worstHop = std::max(worstHop, ride.hop);
            }
        }
    }
    record("worstSpeedError", worstSpeed);
    record("worstHop_m", worstHop);
}

TEST(Tiles, SeamsOfFlushBoxesAreNotFelt)
{
    TRACES("R8", "R7", "T5");
    expectSmoothRides({});
}

TEST(Tiles, SeamsOfFlushSegmentsAreNotFelt)
{
    TRACES("R8", "R7", "T5");
    expectSmoothRides({.segments = true});
}

TEST(Tiles, SeamsAreNotFeltByBodiesThatCouldBounce)
{
    TRACES("R8", "R7", "T5", "DD12");
    for (const double restitution : {0.5, 1.0}) expectSmoothRides({.restitution = restitution});
}

TEST(Tiles, GapsAndOverlapsOfATenthOfAMillimetreAreNotFeltBetweenBoxes)
{
    TRACES("R8", "R7", "T5");
    expectSmoothRides({.off = 1e-4});
}

TEST(Tiles, GapsAndOverlapsOfATenthOfAMillimetreAreNotFeltBetweenSegments)
{
    TRACES("R8", "R7", "T5");
    expectSmoothRides({.segments = true, .off = 1e-4});
}

TEST(Tiles, UnevenByATenthOfAMillimetreAreGlidedOver)
{
    TRACES("R8", "R7", "T5");
    for (const bool segments : {false, true})
        expectSmoothRides({.segments = segments, .off = 1e-4, .uneven = 1e-4});
}

TEST(Tiles, AWallAtTheEndStopsEveryRider)
{
    TRACES("R8", "DD12");
    for (const Rider& rider : kRiders) {
        for (const double speed : {5.0, 20.0}) {
            World world;
            addTiles(world, {.friction = rider.rolls ? 0.6 : 0});
            // Smooth, so that a disc that still turns does not climb it.
            const Body wall = addBox(world, {200, 2}, 1, 4, {.type = BodyType::Static, .friction = 0});
            const Body body = putDown(world, rider, speed, 180);
            double furthest = 0, rebound = 0;
            int stepsSinceTouch = -1;
            runSeconds(world, 20 / speed + 1, 60, 4, [&] {
                furthest = std::max(furthest, body.position().x);
                if (stepsSinceTouch >= 0 || world.touching(body.id(), wall.id())) ++stepsSinceTouch;
                if (stepsSinceTouch > 6) rebound = std::max(rebound, std::abs(velocityOf(body).x) / speed);
            });
            const double stopsAt = 199.5 - 0.5;
            const std::string what = std::string(rider.name) + " at " + std::to_string(int(speed));
            EXPECT_GE(stepsSinceTouch, 0) << what << " never touched the wall";
            EXPECT_LE(furthest, stopsAt) << what;
            EXPECT_LE(rebound, 1e-3) << what;
            EXPECT_GE(body.position().x, stopsAt - 0.02) << what;
        }
    }
}

// A frictionless box of 1 m with C_R = 0 hits a step: its front face stops at the step's corner and its
// front corner stays on the floor. Both impulses at once leave one way to turn:
//     v_x = -w l, v_y = w / 2,  w = m v l / (I + m l^2 + m / 4),  l = 0.5 - step.
void expectTrip(double step, double speed, int substeps, double tolerance)
{
    World world;
    addTiles(world, {.step = step});
    // The hit falls 98 % into a step of the world, so that gravity has no time to change the spin.
    const double gap = restGapFor(world, 1);
    const double way = (20 + 0.98) * speed / 60;
    const Body body =
        addBox(world, {99.5 - 0.5 - gap - way, 0.5 + gap}, 1, 1, {.velocity = vec(speed, 0), .friction = 0});
    runSeconds(world, 20.0 / 60, 60, substeps);
    EXPECT_LE(relativeError(velocityOf(body).x, speed), 1e-6) << "before the step of " << step;
    world.step(1.0 / 60, substeps);
    const double m = static_cast<double>(body.mass()), inertia = static_cast<double>(body.inertia());
    const double l = 0.5 - step;
    const double w = m * speed * l / (inertia + m * l * l + m / 4);
    EXPECT_LE(relativeError(-spinOf(body), w), tolerance)
        << step << " at " << speed << ": spin " << spinOf(body) << ", expected " << -w;
    EXPECT_LE(relativeError(velocityOf(body).x, w * l), tolerance) << step << " at " << speed;
    EXPECT_LE(relativeError(velocityOf(body).y, w / 2), tolerance) << step << " at " << speed;
    record("spinError_" + std::to_string(int(step * 1000)) + "mm_" + std::to_string(int(speed)) + "_" +
               std::to_string(substeps),
           -spinOf(body) / w - 1);
}

TEST(Tiles, AStepTripsABoxAsTheClosedFormSays)
{
    TRACES("R8", "DD8", "DD12");
    for (const double step : {0.003, 0.02, 0.2})
        for (const double speed : {5.0, 20.0}) expectTrip(step, speed, 4, 0.01);
}

// The box is hit at the end of a tick in which it had gone straight: wall and floor stop it by turns, and
// each must see where its corner is by then.
TEST(Tiles, AStepTripsABoxAlikeWithHalfTheSubsteps)
{
    TRACES("R8", "DD8", "DD12");
    for (const double step : {0.003, 0.02, 0.2})
        for (const double speed : {5.0, 20.0}) expectTrip(step, speed, 2, 0.02);
}

}  // namespace
}  // namespace tamias2d::test
