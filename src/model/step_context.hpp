// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/model/defs.hpp>
#include <tamias2d/model/tuning.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The numbers of one step, shared by all its stages.
///
/// A sub-step is made of two ticks, each with one pass over the contacts: that solves better, at the
/// same cost, than one tick with two passes (docs/theory/calm.md).
struct StepContext {
    double time = 0;        ///< of the world's clock at the start   [s]
    double dt = 0;          ///< of the whole step                   [s]
    int ticks = 0;          ///< two for each sub-step
    real h = 0;             ///< length of a tick                    [s]
    real invH = 0;          ///< [1/s]
    real lengthUnit = 1;    ///< [m]
    real mostSteady = 0;    ///< that contacts may change a velocity by in a tick   [m/s]
    real mostSteadySpin = 0;   ///< [rad/s]
    Tuning tuning;

    /// Fastest push, all of which is done in one tick of the step.   [m/s]
    real mostPush() const { return tuning.pushSpeed * lengthUnit * static_cast<real>(ticks); }
    real calmSpeed() const { return tuning.calmSpeed * lengthUnit; }
};

inline StepContext makeStepContext(const Tuning& tuning, real lengthUnit, double time, double dt,
                                   int substeps)
{
    StepContext context;
    context.time = time;
    context.dt = dt;
    context.ticks = 2 * substeps;
    context.h = static_cast<real>(dt / context.ticks);
    context.invH = 1 / context.h;
    context.lengthUnit = lengthUnit;
    context.mostSteady = static_cast<real>(2 * kMaxSpeed * static_cast<double>(lengthUnit) / context.ticks);
    context.mostSteadySpin = static_cast<real>(2 * kMaxSpin / context.ticks);
    context.tuning = tuning;
    return context;
}

/// The step in one tick. What is calmed loses as much speed in it as in all.
inline StepContext wholeTick(const StepContext& context)
{
    StepContext whole = context;
    whole.ticks = 1;
    whole.h = static_cast<real>(context.dt);
    whole.invH = 1 / whole.h;
    whole.mostSteady = static_cast<real>(context.ticks) * context.mostSteady;
    whole.mostSteadySpin = static_cast<real>(context.ticks) * context.mostSteadySpin;
    real kept = 1;
    for (int tick = 0; tick < context.ticks; ++tick) kept *= 1 - context.tuning.calmRate;
    whole.tuning.calmRate = 1 - kept;
    return whole;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
