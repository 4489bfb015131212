// SPDX-License-Identifier: MIT
#include "experiments.hpp"
#include "measure.hpp"

#include <cmath>

namespace tamias2d::verify {
namespace {

State moved(State s, double t)
{
    s.position = s.position + t * s.velocity;
    s.angle += t * s.spin;
    return s;
}

Vec velocityAt(const State& s, Vec arm)
{
    return s.velocity + s.spin * Vec{-arm.y, arm.x};
}

void push(const SceneBody& body, State& s, Vec arm, Vec impulse)
{
    s.velocity = s.velocity + 1 / body.mass * impulse;
    s.spin += cross(arm, impulse) / body.inertia;
}

// DD8: the velocities after a frictionless impact at `point`, normal from a to b.
void collide(const SceneBody& a, State& sa, const SceneBody& b, State& sb, Vec point, Vec normal,
             double restitution)
{
    const Vec ra = point - sa.position, rb = point - sb.position;
    const double approach = dot(normal, velocityAt(sb, rb) - velocityAt(sa, ra));
    const double na = cross(ra, normal), nb = cross(rb, normal);
    const double j =
        -(1 + restitution) * approach / (1 / a.mass + 1 / b.mass + na * na / a.inertia + nb * nb / b.inertia);
    push(a, sa, ra, -j * normal);
    push(b, sb, rb, j * normal);
}

Scene twoBodies(SceneBody a, SceneBody b, double restitution)
{
    Scene scene;
    scene.gravity = {};
    scene.friction = 0;
    scene.restitution = restitution;
    scene.add(std::move(a));
    scene.add(std::move(b));
    return scene;
}

// The velocities of both bodies half a second after the impact.
Values velocitiesAfter(const EngineKind& kind, const Scene& scene, double impactTime)
{
    Trial trial(kind, scene);
    trial.run(impactTime + 0.5);
    Values values;
    for (const State& s : trial.states()) {
        values.push_back(s.velocity.x);
        values.push_back(s.velocity.y);
        values.push_back(s.spin);
    }
    return values;
}

std::vector<Quantity> sixVelocities(const Scene& scene, const State& a, const State& b)
{
    // A component that happens to be small is compared with the speeds of the scene, not with itself.
    const double speed =
        std::max(length(scene.bodies[0].start.velocity), length(scene.bodies[1].start.velocity));
    return {{"A: v_x", "m/s", a.velocity.x, speed}, {"A: v_y", "m/s", a.velocity.y, speed},
            {"A: spin", "rad/s", a.spin, speed},    {"B: v_x", "m/s", b.velocity.x, speed},
            {"B: v_y", "m/s", b.velocity.y, speed}, {"B: spin", "rad/s", b.spin, speed}};
}

// A disc meets the left side of a resting box, 0.6 m above its center.
void discOnBox(Report& report)
{
    const Scene scene = twoBodies(disc(0.25, {-3, 0.6}, {5, 0}), box(1, 2, {}), 0.8);
    State a = scene.bodies[0].start, b = scene.bodies[1].start;
    const double t = (3 - 0.5 - 0.25) / 5;
    a = moved(a, t);
    collide(scene.bodies[0], a, scene.bodies[1], b, {-0.5, 0.6}, {1, 0}, scene.restitution);
    report.measure("Disc on box, off center, C_R = 0.8", sixVelocities(scene, a, b),
                   [&](const EngineKind& kind) { return velocitiesAfter(kind, scene, t); });
}

// A turning box falls with a corner onto the top of a plate that moves and turns as well. The time
// of impact is found by bisection of the corner's height over the plate.
void cornerOnEdge(Report& report)
{
    const Scene scene =
        twoBodies(box(1, 1, {0.7, 2.5}, 0.5, {0.2, -4}, 1.2), box(6, 1, {0, 0}, 0.05, {0.3, 0.5}, -0.2), 0.5);
    const SceneBody &boxBody = scene.bodies[0], &plate = scene.bodies[1];
    const auto up = [&](double t) { return turned({0, 1}, moved(plate.start, t).angle); };
    const auto height = [&](double t) {
        const Vec corner = lowest(boxBody, moved(boxBody.start, t), up(t)).point;
        return dot(up(t), corner - moved(plate.start, t).position) - 0.5;
    };
    double before = 0, after = 1;
    for (int i = 0; i < 80; ++i) {
        const double middle = (before + after) / 2;
        (height(middle) > 0 ? before : after) = middle;
    }
    State a = moved(boxBody.start, after), b = moved(plate.start, after);
    const Vec normal = up(after);
    collide(boxBody, a, plate, b, lowest(boxBody, a, normal).point, -1 * normal, scene.restitution);
    report.measure("Corner on edge, both turning, C_R = 0.5", sixVelocities(scene, a, b),
                   [&](const EngineKind& kind) { return velocitiesAfter(kind, scene, after); });
}

// A box lands flat on a free plate, off its center. Both ends of the shared edge part with C_R times
// the speed they met with, so neither body turns against the other: one impulse at the place
// where that holds, from momentum balance.
void flatOnEdge(Report& report)
{
    constexpr double e = 0.6, speed = 3;
    const Scene scene = twoBodies(box(1, 1, {0.3, 2}, 0, {0, -speed}), box(4, 1, {}), e);
    const SceneBody &boxBody = scene.bodies[0], &plate = scene.bodies[1];
    // J at offset s from the box's center: spin J s / I_A up on the box, -J (s + 0.3) / I_B on the plate.
    const double s = -0.3 / plate.inertia / (1 / boxBody.inertia + 1 / plate.inertia);
    const double arm = s + 0.3;
    const double spinA = s / boxBody.inertia, spinB = -arm / plate.inertia;  // of J = 1: equal
    const double j = (1 + e) * speed / (1 / boxBody.mass + 1 / plate.mass + s * spinA - arm * spinB);
    State a = boxBody.start, b = plate.start;
    a.velocity.y += j / boxBody.mass;
    a.spin = j * spinA;
    b.velocity.y = -j / plate.mass;
    b.spin = j * spinB;
    const double t = 1 / speed;
    report.measure("Edge on edge, flat, off center, C_R = 0.6", sixVelocities(scene, a, b),
                   [&](const EngineKind& kind) { return velocitiesAfter(kind, scene, t); });
}

// Two discs of different size pass each other's center lines by 0.4 m.
void obliqueDiscs(Report& report)
{
    const Scene scene = twoBodies(disc(0.5, {-2, 0}, {3, 0}), disc(0.7, {2, 0.4}, {-1, 0}), 1);
    State a = scene.bodies[0].start, b = scene.bodies[1].start;
    const double apart = std::sqrt(1.2 * 1.2 - 0.4 * 0.4), t = (4 - apart) / 4;
    a = moved(a, t);
    b = moved(b, t);
    const Vec normal = 1 / 1.2 * (b.position - a.position);
    collide(scene.bodies[0], a, scene.bodies[1], b, a.position + 0.5 * normal, normal, 1);
    std::vector<Quantity> quantities = sixVelocities(scene, a, b);
    report.measure("Two discs, oblique, C_R = 1", quantities,
                   [&](const EngineKind& kind) { return velocitiesAfter(kind, scene, t); });
}

// Discs in a row at the engine's rest gap, hit by one or two at 2 m/s: as many leave, as fast.
Values cradle(const EngineKind& kind, int strikers)
{
    Scene scene;
    scene.gravity = {};
    scene.friction = 0;
    scene.restitution = 1;
    const SceneBody unit = disc(0.5, {});
    const double pitch = 1 + std::max(0.0, kind.restGap(unit, unit));
    for (int i = 0; i < 5; ++i) {
        const bool strikes = i < strikers;
        scene.add(disc(0.5, {i * pitch - (strikes ? 1.237 : 0), 0}, {strikes ? 2.0 : 0, 0}));
    }
    Trial trial(kind, scene);
    trial.run(1.5);
    Values speeds;
    for (const State& s : trial.states()) speeds.push_back(s.velocity.x);
    return speeds;
}

}  // namespace

void impacts(Report& report)
{
    report.group(
        "Single impacts (R8, DD8, DD10, DD11)",
        "Velocities after one frictionless impact, against DD8 evaluated at the exact place and time of the "
        "impact. Percentages are of the fastest initial speed in m/s (spins: of that figure in rad/s). What "
        "is left in Tamias2D comes from its rest gap: bodies meet 0.1 % of their width earlier, and the "
        "place and "
        "normal of the impact lie within that gap. DD8 with the place and normal that it reports holds to "
        "rounding; "
        "the tests show that.");
    discOnBox(report);
    cornerOnEdge(report);
    flatOnEdge(report);
    obliqueDiscs(report);
    for (int strikers : {1, 2}) {
        std::vector<Quantity> speeds;
        for (int i = 0; i < 5; ++i)
            speeds.push_back({"ball " + std::to_string(i + 1), "m/s", i >= 5 - strikers ? 2.0 : 0.0, 2.0});
        report.measure("Newton's cradle, " + std::to_string(strikers) + " of 5", speeds,
                       [strikers](const EngineKind& kind) { return cradle(kind, strikers); });
    }
}

}  // namespace tamias2d::verify
