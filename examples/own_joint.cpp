// SPDX-License-Identifier: MIT
// Two joints of one's own: a bead on a wire, and a differential.
#include <tamias2d/tamias2d.hpp>

#include <cstdio>

using namespace tamias2d;

/// A bead on a wire of the form y = x^2/2: one row, C = y - x^2/2.
struct OnParabola {
    static constexpr int bodies = 1;
    static constexpr std::string_view name = "OnParabola";

    void measure(std::span<const ConstraintBody> at, ConstraintRows& rows) const
    {
        const Position p = at[0].center;
        rows.rigid(p.y - p.x * p.x / 2).move(0, {static_cast<real>(-p.x), 1});
    }
};

/// The cage of a differential (body 2) turns by the mean of its two axles: C = (a0 + a1)/2 - a2.
struct Differential {
    static constexpr int bodies = 3;
    static constexpr std::string_view name = "Differential";

    void measure(std::span<const ConstraintBody> at, ConstraintRows& rows) const
    {
        const real half = real(0.5);
        rows.rigid((at[0].turned + at[1].turned) / 2 - at[2].turned).turn(0, half).turn(1, half).turn(2, -1);
    }
};

int main()
{
    World world;
    Body bead = world.createBody({.position = {2, 2}});
    bead.createShape({.geometry = Circle{{}, real(0.1)}});
    Joint wire = world.createJoint(OnParabola{}, bead);
    double highest = 0;
    for (int step = 0; step < 600; ++step) {
        world.step();
        if (world.time() > 5) highest = bead.position().y > highest ? bead.position().y : highest;
    }
    std::printf("the bead still climbs to %.2f m, %.0f mm off its wire\n", highest,
                1000 * static_cast<double>(wire.reading().error));

    World garage({.gravity = {}});
    Body frame = garage.createBody({.type = BodyType::Static});
    Body wheels[3];
    for (int i = 0; i < 3; ++i) {
        wheels[i] = garage.createBody({.position = {2.0 * i, 0}});
        wheels[i].createShape({.geometry = Circle{{}, real(0.5)}});
        garage.createJoint(revoluteAt(frame, wheels[i], wheels[i].position()));
    }
    Joint gears = garage.createJoint(Differential{}, wheels[0], wheels[1], wheels[2]);
    for (int step = 0; step < 60; ++step) {
        wheels[2].applyTorque(1);                                         // an engine drives the cage,
        wheels[0].applyTorque(-2 * wheels[0].angularVelocity());          // one wheel runs in mud
        garage.step();
    }
    std::printf("%.2f and %.2f rad/s make %.2f\n", static_cast<double>(wheels[0].angularVelocity()),
                static_cast<double>(wheels[1].angularVelocity()),
                static_cast<double>(wheels[2].angularVelocity()));
    std::printf("each wheel gets %.2f N*m\n", static_cast<double>(gears.rowReadings()[0].force) / 2);
}
