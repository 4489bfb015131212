// SPDX-License-Identifier: MIT
#include "base/check.hpp"

#include <tamias2d/math/scalar.hpp>
#include <tamias2d/world/fixed_stepper.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

FixedStepper::FixedStepper(double step, int substeps, double maxFrame)
    : step_(step), substeps_(substeps), maxFrame_(maxFrame)
{
    if (!Checks()
             .that(step >= 1e-12 && step <= 1, "step", step, "must be in [1e-12, 1] s")
             .range("substeps", substeps, 1, 256, "must be in [1, 256]")
             .range("maxFrame", maxFrame, step, kAnyFinite, "must be finite and >= step, in s")
             .refuse())
        return;
    step_ = 1.0 / 60.0;
    substeps_ = 4;
    maxFrame_ = 0.25;
}

int FixedStepper::advance(World& world, double seconds)
{
    if (refuseFrame(seconds)) return 0;
    const double taken = minimum(seconds, maxFrame_);
    dropped_ += seconds - taken;

    // Kahan's summation: frames of 1/24 s must not lose a step in an hour.
    const double corrected = taken - pendingLow_;
    const double sum = pending_ + corrected;
    pendingLow_ = (sum - pending_) - corrected;
    pending_ = sum;

    int steps = 0;
    while (pending_ >= step_ * (1 - 1e-9)) {  // a frame that ends with a step makes that step
        world.step(step_, substeps_);
        pending_ -= step_;
        ++steps;
    }
    return steps;
}

bool FixedStepper::refuseFrame(double seconds)
{
    return Checks().range("seconds", seconds, 0, kAnyFinite, "must be finite and >= 0 s").refuse();
}

double FixedStepper::alpha() const noexcept
{
    return clamp(pending_ / step_, 0.0, 1.0);
}
double FixedStepper::dropped() const noexcept
{
    return dropped_;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
