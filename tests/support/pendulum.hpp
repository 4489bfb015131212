// SPDX-License-Identifier: MIT
#pragma once

#include "support/build.hpp"
#include "support/run.hpp"

// A pendulum released from level, and what its closed form says.
namespace tamias2d::test {

inline constexpr double kQuarterPeriod = 1.8540746773013719;  // K(sin 45 degrees): released from level

/// A disc of 1 kg, its center 1 m from a static pivot; nothing ties them yet.
struct LevelPendulum {
    World world;
    Body pivot = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
    Body bob = addDisc(world, {1, 0}, 0.1, {.density = 1 / (kPi * 0.01)});

    /// On a pivot the disc turns with the swing, on a rod it need not.   [s]
    double exactPeriod(bool turns) const
    {
        const double turning = turns ? static_cast<double>(bob.inertia()) : 0;
        return 4 * kQuarterPeriod * std::sqrt((1 + turning) / kGravity);
    }
};

/// What a hundred seconds of swinging show.
struct Swings {
    double mostEnergy = 0;   // off that at the start   [J]
    int count = 0;           // through the lowest point, from left to right
    double period = 0;       // mean of them   [s]
};

inline Swings swingForAHundredSeconds(LevelPendulum& p)
{
    Swings swings;
    const double start = p.world.energy().total();
    double first = 0, last = 0, angle = -1;
    runSeconds(p.world, 100, 60, 4, [&] {
        swings.mostEnergy = std::max(swings.mostEnergy, std::abs(p.world.energy().total() - start));
        const DVec2 c = centerOf(p.bob);
        const double now = std::atan2(c.x, -c.y);
        if (angle < 0 && now >= 0 && now < 1) {
            last = p.world.time() - now / (now - angle) / 60;
            if (++swings.count == 1) first = last;
        }
        angle = now;
    });
    swings.period = (last - first) / (swings.count - 1);
    return swings;
}

}  // namespace tamias2d::test
