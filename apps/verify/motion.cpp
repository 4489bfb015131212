// SPDX-License-Identifier: MIT
#include "experiments.hpp"
#include "measure.hpp"

#include <cmath>
#include <numbers>

namespace tamias2d::verify {
namespace {

constexpr double kPi = std::numbers::pi;

Scene loneBody(const State& start)
{
    Scene scene;
    scene.gravity = {};
    SceneBody body = disc(0.5, {});
    body.mass = 2;
    body.inertia = 0.5;
    body.start = start;
    scene.add(body);
    return scene;
}

// Engines that keep angles in [0, 2 pi) have lost the turns: take the one nearest to what is expected.
double unwrapped(double angle, double expected)
{
    return expected + std::remainder(angle - expected, 2 * kPi);
}

}  // namespace

void freeMotion(Report& report)
{
    report.group(
        "Free motion (R5, R6, T1, T4, IM1, IM2)",
        "One body of 2 kg and 0.5 kg*m^2 that touches nothing, against closed forms. All at 60 steps a "
        "second. Steady forces are given to the peers anew before each step.");

    report.measure("Free fall, 10 s", {{"height", "m", -490.5}, {"speed down", "m/s", -98.1}},
                   [](const EngineKind& kind) {
                       Scene scene = loneBody({});
                       scene.gravity = {0, -9.81};
                       Trial trial(kind, scene);
                       trial.run(10);
                       return Values{trial.state(0).position.y, trial.state(0).velocity.y};
                   });

    report.measure("Projectile at (12, 20) m/s, 3 s", {{"x", "m", 36}, {"y", "m", 60 - 4.5 * 9.81}},
                   [](const EngineKind& kind) {
                       Scene scene = loneBody({{}, 0, {12, 20}, 0});
                       scene.gravity = {0, -9.81};
                       Trial trial(kind, scene);
                       trial.run(3);
                       return Values{trial.state(0).position.x, trial.state(0).position.y};
                   });

    report.measure("Free spin at 7 rad/s, 1 h", {{"angle turned", "rad", 25200}}, [](const EngineKind& kind) {
        Trial trial(kind, loneBody({{}, 0, {}, 7}));
        trial.run(3600);
        return Values{unwrapped(trial.state(0).angle, 25200)};
    });

    report.measure("Steady 3 N on an arm of 0.2 m, 10 s",
                   {{"x", "m", 75}, {"speed", "m/s", 15}, {"angle turned", "rad", 60}, {"spin", "rad/s", 12}},
                   [](const EngineKind& kind) {
                       Scene scene = loneBody({});
                       scene.pull = [](const State&, double) { return Pull{{3, 0}, 0.6}; };
                       Trial trial(kind, scene);
                       trial.run(10);
                       const State s = trial.state(0);
                       return Values{s.position.x, s.velocity.x, unwrapped(s.angle, 60), s.spin};
                   });

    const double left = std::exp(-5.0);
    report.measure("Damping exp(-0.5 t), 10 s",
                   {{"x", "m", 20 * (1 - left)}, {"speed", "m/s", 10 * left}, {"spin", "rad/s", 6 * left}},
                   [](const EngineKind& kind) {
                       Scene scene = loneBody({{}, 0, {10, 0}, 6});
                       scene.damping = 0.5;
                       Trial trial(kind, scene);
                       trial.run(10);
                       return Values{trial.state(0).position.x, trial.state(0).velocity.x,
                                     trial.state(0).spin};
                   });
}

namespace {

// k = pi^2 N/m on 1 kg: a period of 2 s, 120 steps. Starts at rest at x = 1 m.
Values oscillator(const EngineKind& kind)
{
    Scene scene = loneBody({{1, 0}, 0, {}, 0});
    scene.bodies[0].mass = 1;
    scene.pull = [](const State& s, double) { return Pull{{-kPi * kPi * s.position.x, 0}, 0}; };
    Trial trial(kind, scene);
    trial.run(30);
    const State s = trial.state(0);
    const double energy = (s.velocity.x * s.velocity.x + kPi * kPi * s.position.x * s.position.x) / 2;
    return {energy / (kPi * kPi / 2), s.position.x};
}

// 3 kg and 1 kg on ellipses of eccentricity 0.5 with a period of 8 s (480 steps), from apoapsis.
Values orbit(const EngineKind& kind)
{
    constexpr double total = 4, axis = 2, period = 8, far = 3;
    const double mu = 4 * kPi * kPi * axis * axis * axis / (period * period);
    const double speed = std::sqrt(mu * (2 / far - 1 / axis));
    Scene scene;
    scene.gravity = {};
    scene.gravitation = mu / total;
    for (int i = 0; i < 2; ++i) {
        SceneBody body =
            disc(0.05, {i == 0 ? -far / 4 : far * 3 / 4, 0}, {0, i == 0 ? -speed / 4 : speed * 3 / 4});
        body.mass = i == 0 ? 3 : 1;
        body.inertia = 0.01;
        scene.add(body);
    }
    const auto energy = [&](const std::vector<State>& s) {
        return kineticEnergy(scene, s) - scene.gravitation * 3 / length(s[1].position - s[0].position);
    };
    Trial trial(kind, scene);
    const std::vector<State> start = trial.states();
    const double spin = momenta(scene, start).angular;
    trial.run(100 * period);
    const std::vector<State> end = trial.states();
    const Vec miss = (end[1].position - end[0].position) - (start[1].position - start[0].position);
    return {energy(end) / energy(start), momenta(scene, end).angular / spin,
            length(momenta(scene, end).linear) / momenta(scene, start).linearMagnitude, length(miss)};
}

}  // namespace

void placeForces(Report& report)
{
    report.group(
        "Forces that depend on place (T3, GD2, 5.2.7)",
        "Tamias2D evaluates a force law in every sub-step. The peers are given the force before each step, "
        "as their users do, and hold it. Over 100 periods even a small error of the period adds up: "
        "the last row is how far the pair then is from where it began, against the semi-major axis of 2 m.");
    report.measure("Spring, 15 periods of 120 steps", {{"energy left", "1", 1}, {"x", "m", 1}}, oscillator);
    report.measure("Ellipse e = 0.5 under T3, 100 periods of 480 steps",
                   {{"energy left", "1", 1},
                    {"angular momentum left", "1", 1},
                    {"linear momentum gained", "1", 0, 1},
                    {"miss of the start", "m", 0, 2}},
                   orbit);
}

}  // namespace tamias2d::verify
