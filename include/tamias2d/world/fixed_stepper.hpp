// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/world/world.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Drives a World at a fixed step from frames of any length, so that results do not depend on the
/// frame rate: call advance() once a frame, draw body.interpolated(stepper.alpha()).
class FixedStepper {
public:
    /// @param step       length of one step                      [s]   in (0, 1]
    /// @param substeps   of each                                       in [1, 256]
    /// @param maxFrame   longest frame taken in; more is dropped [s]   >= step
    explicit FixedStepper(double step = 1.0 / 60.0, int substeps = 4, double maxFrame = 0.25);

    /// Takes in a frame of `seconds` >= 0 and makes the steps that are due; returns how many.
    int advance(World& world, double seconds);

    double alpha() const noexcept;    ///< how far into the next step we are, in [0, 1]
    double dropped() const noexcept;  ///< time lost to maxFrame so far   [s]
    double step() const noexcept { return step_; }

private:
    static bool refuseFrame(double seconds);

    double step_;
    int substeps_;
    double maxFrame_;
    double pending_ = 0;  // time taken in and not yet stepped; compensated, so 24 frames of 1/24 are 1 s
    double pendingLow_ = 0;
    double dropped_ = 0;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
