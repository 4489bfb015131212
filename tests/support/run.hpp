// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/tamias2d.hpp>

#include <algorithm>
#include <cmath>

// Runs a world and measures it.
namespace tamias2d::test {

/// What all steps of a run reported together.
struct RunTotals {
    int steps = 0;
    std::uint64_t impacts = 0;
    std::uint64_t clampedBodies = 0;   ///< speed, spin and place: must stay 0 in sane scenes
    std::uint64_t clampedContacts = 0; ///< pushes, impacts and advancement
    std::uint64_t faults = 0;          ///< non-finite bodies, faulty laws, steps not done
    double deepestOverlap = 0;         ///< as the reports say          [m]
    double highestEnergyRise = 0;      ///< of one step                 [J]
    double sumOfEnergyRises = 0;       ///< over all steps              [J]
    double highestEnergy = 0;          ///< total, start included       [J]
};

/// Steps the world for `seconds` at `rate` steps a second, and calls each() after every step.
template <class Each>
RunTotals runSeconds(World& world, double seconds, double rate, int substeps, Each&& each)
{
    RunTotals totals;
    double before = world.energy().total();
    totals.highestEnergy = before;
    const int steps = static_cast<int>(std::lround(seconds * rate));
    for (; totals.steps < steps; ++totals.steps) {
        const StepReport report = world.step(1.0 / rate, substeps);
        totals.impacts += report.impacts;
        totals.clampedBodies += report.clamps.speed + report.clamps.position;
        totals.clampedContacts +=
            report.clamps.push + report.clamps.impactsPerContact + report.clamps.advancement;
        totals.faults += report.nonFinite + report.forceLawFaults + (report.status != StepStatus::Done);
        totals.deepestOverlap = std::max(totals.deepestOverlap, report.deepestOverlap);
        const double after = world.energy().total();
        totals.highestEnergyRise = std::max(totals.highestEnergyRise, after - before);
        totals.sumOfEnergyRises += std::max(after - before, 0.0);
        totals.highestEnergy = std::max(totals.highestEnergy, after);
        before = after;
        each();
    }
    return totals;
}

inline RunTotals runSeconds(World& world, double seconds, double rate = 60, int substeps = 4)
{
    return runSeconds(world, seconds, rate, substeps, [] {});
}

/// The speed of the fastest enabled dynamic body's center [m/s].
inline double fastestBody(World& world)
{
    double fastest = 0;
    for (const BodyId id : world.bodies()) {
        const Body body = world.body(id);
        if (body.type() != BodyType::Dynamic || !body.isEnabled()) continue;
        fastest = std::max(fastest, length(toDVec2(body.linearVelocity())));
    }
    return fastest;
}

/// |a - b| over the larger of |b| and `scale`.
inline double relativeError(double a, double b, double scale = 0)
{
    const double size = std::max(std::abs(b), scale);
    return size > 0 ? std::abs(a - b) / size : std::abs(a);
}
inline double relativeError(DVec2 a, DVec2 b, double scale = 0)
{
    const double size = std::max(length(b), scale);
    return size > 0 ? length(a - b) / size : length(a);
}

/// a - b on the circle, in [-pi, pi) [rad].
inline double angleDifference(double a, double b)
{
    const double turns = (a - b + kPi) / kTwoPi;
    return kTwoPi * (turns - std::floor(turns)) - kPi;
}

inline DVec2 velocityOf(const Body& body)
{
    return toDVec2(body.linearVelocity());
}
inline double spinOf(const Body& body)
{
    return static_cast<double>(body.angularVelocity());
}
inline DVec2 centerOf(const Body& body)
{
    return body.centerOfMass() - Position{};
}

}  // namespace tamias2d::test
