// SPDX-License-Identifier: MIT
// Friction decides what slides: three boxes on a ramp of 20 degrees.
#include <tamias2d/tamias2d.hpp>

#include <cstdio>

int main()
{
    using namespace tamias2d;
    constexpr double kSlope = 20 * kPi / 180;

    World world;
    Body ramp = world.createBody({.type = BodyType::Static, .angle = kSlope});
    // The friction of a contact is what the rule says: here simply the box's own value.
    ramp.createShape({.geometry = Segment{.a = {-200, 0}, .b = {200, 0}},
                      .material = {.friction = 1, .frictionMixing = MixingRule::Minimum}});

    const float frictions[] = {0.1f, 0.3f, 0.5f};  // tan 20 degrees is 0.364
    Body boxes[3];
    for (int i = 0; i < 3; ++i) {
        const Transform onRamp = Transform::at({}, kSlope);
        boxes[i] = world.createBody(
            {.position = toWorld(onRamp, {5 * static_cast<real>(i), real(0.501)}), .angle = kSlope});
        boxes[i].createShape({.geometry = makeBox(1, 1), .material = {.friction = frictions[i]}});
    }

    for (int i = 0; i < 120; ++i) world.step();
    for (int i = 0; i < 3; ++i) {
        std::printf("friction %.1f: %.2f m/s after 2 s\n", static_cast<double>(frictions[i]),
                    static_cast<double>(length(boxes[i].linearVelocity())));
    }
}
