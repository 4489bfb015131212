// SPDX-License-Identifier: MIT
// Runs a few busy worlds through the public API and prints one state hash for each. matrix.sh builds this
// with many compilers and switches; every build must print the same lines.

#include <tamias2d/tamias2d.hpp>

#include <cinttypes>
#include <cstdint>
#include <cstdio>

using namespace tamias2d;

namespace {

constexpr int kSteps = 300;

// Numbers that look random and are the same everywhere: exact in double and in float.
class Dice {
public:
    real between(real low, real high)
    {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        const auto part = static_cast<real>(state_ >> 48) / real(65536);
        return low + (high - low) * part;
    }

private:
    std::uint64_t state_ = 2026;
};

void addFloor(World& world)
{
    Body ground = world.createBody({.type = BodyType::Static});
    ground.createShape({.geometry = makeBox(40, 1), .offset = {0, real(-0.5)}});
    ground.createShape({.geometry = Segment{.a = {-12, 0}, .b = {-12, 30}}});
    ground.createShape({.geometry = Segment{.a = {12, 0}, .b = {12, 30}}});
}

// Friction, restitution, stacking, rounding: boxes fall onto each other.
void pile(World& world)
{
    Dice dice;
    addFloor(world);
    for (int i = 0; i < 40; ++i) {
        Body box = world.createBody({.position = {double(i % 5) * 1.3 - 2.6, 1.0 + double(i / 5) * 1.4},
                                     .angle = double(dice.between(-1, 1)),
                                     .linearVelocity = {dice.between(-1, 1), dice.between(-3, 0)}});
        const real radius = i % 3 == 0 ? real(0.1) : real(0);
        // Drawn one by one: the order in which arguments are evaluated is the compiler's choice.
        const real width = dice.between(real(0.5), 1);
        const real height = dice.between(real(0.5), 1);
        box.createShape({.geometry = makeBox(width, height, radius),
                         .material = {.friction = dice.between(0, 1), .restitution = dice.between(0, 1)}});
    }
}

// Impulses at their times: fast spinning polygons in a box without gravity.
void polygons(World& world)
{
    Dice dice;
    world.setGravity({0, 0});
    Body walls = world.createBody({.type = BodyType::Static});
    const Vec2 corners[] = {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}};
    for (int i = 0; i < 4; ++i) {
        walls.createShape({.geometry = Segment{.a = corners[i], .b = corners[(i + 1) % 4]},
                           .material = {.restitution = 1}});
    }
    for (int i = 0; i < 25; ++i) {
        Body body = world.createBody({.position = {double(i % 5) * 2.5 - 5, double(i / 5) * 2.5 - 5},
                                      .linearVelocity = {dice.between(-20, 20), dice.between(-20, 20)},
                                      .angularVelocity = dice.between(-30, 30)});
        body.createShape({.geometry = makeRegularPolygon(3 + i % 8, dice.between(real(0.4), real(0.9))),
                          .material = {.friction = real(0.3), .restitution = real(0.9)}});
    }
}

// Capsules and discs with rolling resistance, a belt that runs, a paddle that turns, several shapes on a
// body.
void machines(World& world)
{
    Dice dice;
    addFloor(world);
    Body belt = world.createBody({.type = BodyType::Static, .position = {0, 2}, .angle = 0.1});
    belt.createShape({.geometry = makeBox(8, real(0.4)), .material = {.surfaceSpeed = real(1.5)}});
    Body paddle = world.createBody({.type = BodyType::Kinematic, .position = {-5, 3}, .angularVelocity = 2});
    paddle.createShape({.geometry = makeBox(4, real(0.3))});
    for (int i = 0; i < 30; ++i) {
        Body body = world.createBody({.position = {double(i % 6) * 1.7 - 4, 5.0 + double(i / 6) * 1.7},
                                      .angle = double(dice.between(0, 6)),
                                      .gravityScale = dice.between(real(0.5), real(1.5))});
        const Material rolling = {
            .friction = real(0.7), .restitution = real(0.2), .rollingResistance = real(0.02)};
        if (i % 2 == 0) body.createShape({.geometry = Circle{.radius = real(0.4)}, .material = rolling});
        if (i % 3 != 1)
            body.createShape({.geometry = Capsule{}, .offset = {0, real(0.2)}, .material = rolling});
        if (i % 6 == 1)
            body.createShape({.geometry = makeBox(1, real(0.5)), .angle = 0.3, .material = rolling});
    }
}

// Forces of every kind, damping and gravitation, inside the sub-steps.
void forces(World& world)
{
    Dice dice;
    world.setGravitationConstant(real(0.5));
    world.setGravity({0, real(-0.1)});
    for (int i = 0; i < 12; ++i) {
        Body body = world.createBody({.position = {double(i % 4) * 6, double(i / 4) * 6},
                                      .linearVelocity = {dice.between(-2, 2), dice.between(-2, 2)},
                                      .angularVelocity = dice.between(-3, 3),
                                      .linearDamping = i % 3 == 0 ? real(0.2) : real(0),
                                      .angularDamping = real(0.1)});
        body.createShape({.geometry = Circle{.radius = dice.between(real(0.2), real(0.6))}, .density = 3});
        if (i % 4 == 0) body.addForceLaw(springTo({5, 5}, 4, 0.1));
        if (i % 4 == 1) body.addForceLaw(attractionTo({9, 2}, 30, 0.5));
        if (i % 4 == 2) body.addForceLaw(torsionSpring(1, 2, 0.05));
        if (i % 4 == 3) body.addForce({.force = {1, 2}, .point = {real(0.1), 0}, .forceTurns = true});
    }
    world.addForceLaw(drag(0.01, 0.002));
}

// Stacks that have fallen asleep, one hit by a ball, another thrown at it in mid-step; all sleep again by the
// end.
void sleepers(World& world)
{
    addFloor(world);
    for (int i = 0; i < 30; ++i) {
        Body box = world.createBody({.position = {double(i % 6) * 1.5 - 4, 0.501 + double(i / 6) * 1.001}});
        box.createShape({.geometry = makeBox(1, 1)});
    }
    for (int i = 0; i < 150; ++i) world.step();
    const Material elastic = {.restitution = 1};
    Body ball = world.createBody({.position = {-8, 2}, .linearVelocity = {300, 0}});
    ball.createShape({.geometry = Circle{.radius = real(0.3)}, .material = elastic});
    Body other = world.createBody({.position = {-6, 2}, .awake = false});
    other.createShape({.geometry = Circle{.radius = real(0.3)}, .material = elastic});
}

// Enough of them that loops are shared out to threads.
void heap(World& world)
{
    Dice dice;
    addFloor(world);
    for (int i = 0; i < 240; ++i) {
        Body body = world.createBody({.position = {double(i % 20) * 1.1 - 10.5, 0.6 + double(i / 20) * 1.1},
                                      .angle = double(dice.between(real(-0.2), real(0.2)))});
        if (i % 4 == 0)
            body.createShape({.geometry = Circle{.radius = real(0.5)}});
        else
            body.createShape({.geometry = makeBox(1, dice.between(real(0.6), 1))});
    }
}

// Threads of the probe's own are compared on x86 only; other processors are emulated.
#if defined(__x86_64__)
constexpr int kThreads[] = {2, 3, 8};
#else
constexpr int kThreads[] = {1};
#endif

std::uint64_t hashOf(void (*fill)(World&), int steps, const WorldDef& def)
{
    World world(def);
    fill(world);
    for (int i = 0; i < steps; ++i) world.step();
    return world.stateHash();
}

void print(const char* name, void (*fill)(World&), int steps = kSteps)
{
    const char* const precision = sizeof(real) == 4 ? "f32" : "f64";
    using enum LaneWidth;
    const std::uint64_t first = hashOf(fill, steps, {.lanes = Scalar});
    std::printf("%s %s %016" PRIx64 "\n", precision, name, first);
    for (const LaneWidth lanes : {Bytes16, Bytes32, Bytes64})
        if (hasLanes(lanes) && hashOf(fill, steps, {.lanes = lanes}) != first)
            std::printf("%s %s differs with lanes %d\n", precision, name, static_cast<int>(lanes));
    // A lane of one number makes the most work to share out.
    for (const int threads : kThreads)
        if (hashOf(fill, steps, {.lanes = Scalar, .threads = threads}) != first)
            std::printf("%s %s differs with %d threads\n", precision, name, threads);
}

}  // namespace

int main()
{
    print("pile", pile);
    print("polygons", polygons);
    print("machines", machines);
    print("forces", forces);
    print("sleepers", sleepers);
    print("heap", heap, 60);
}
