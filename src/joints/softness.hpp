// SPDX-License-Identifier: MIT
// How rigid rows that share bodies with others are softened, so that one visit each settles them; and which
// of them bear so much that this will not do.
#pragma once

#include <tamias2d/base/config.hpp>

#include <cstddef>

namespace tamias2d::inline TAMIAS_PRECISION {

/// As a spring of a quarter of the tick's frequency and twice the critical damping [eq. 6].
struct Softness {
    static constexpr double kTurn = 2 * 3.14159265358979323846 * 0.25, kDamping = 2;
    static constexpr double kBlend = kTurn * (2 * kDamping + kTurn);
    static constexpr real kFade =
        static_cast<real>(kTurn / (2 * kDamping + kTurn));  // of an error, in a tick
    static constexpr real kFirm = static_cast<real>(kBlend / (1 + kBlend));
    static constexpr real kLoose = static_cast<real>(1 / (1 + kBlend));
};

/// What has come apart, as by hand, comes back no faster than this.   [lengthUnit/s] or [rad/s]
inline constexpr real kReturn = 20;
/// Of an error, in a tick, where loops tie many bodies that are solved at once: more would do work.
inline constexpr real kMildFade = real(1.0 / 64);

/// Springs that swing faster than this in a tick are damped by it rather than followed [eq. 9].   [rad]
inline constexpr real kFastSpring = 1;

/// How far a rigid row gives way that carries an impulse in every tick, when it is soft; `mass` is its
/// J M^-1 J^T, of either sign of the impulse.   [m] or [rad]
template <class T>
T giveOf(T mass, T impulse, T h)
{
    return T(Softness::kLoose / (Softness::kFirm * Softness::kFade)) * h * mass * impulse;
}

/// Part of its arms by which a soft joint may give way, and for how many ticks on end it must be predicted to
/// do so: by then it would have. What is over sooner is a blow or the correction of an error, and no load.
inline constexpr real kMostGive = real(1e-3);
inline constexpr int kLasting = 4;
inline constexpr int kHold = 30;  // steps for which a group is then solved at once, or is not any more
inline constexpr std::size_t kFew = 4;  // bodies of which solving at once costs no more

}  // namespace tamias2d::inline TAMIAS_PRECISION
