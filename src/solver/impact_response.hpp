// SPDX-License-Identifier: MIT
#pragma once

#include "solver/flight.hpp"
#include "solver/impact_stage.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The record of an impulse at a point of a contact, without time, impulses and number. `centerA` is where
/// A's center is.
ImpactRecord recordOf(const Contact& contact, const Moment& before, Position centerA);

/// Lets impacts act on the flights of their bodies, on the kicks of the tick, and on the records.
class ImpactResponse {
public:
    /// `tickStart` is the start of the tick within the step [s]; `flights` are by row.
    ImpactResponse(ImpactStage& stage, const StepContext& context, Table<Flight>& flights, real tickStart)
        : stage_(stage), context_(context), flights_(flights), tickStart_(tickStart)
    {
    }

    void act(Contact& contact, const Impact& impact);
    FlyingPair pairOf(const Contact& c) const
    {
        return {motion(c.rowA), motion(c.rowB), flights_[c.rowA], flights_[c.rowB]};
    }

private:
    ImpactStage& stage_;
    const StepContext& context_;
    Table<Flight>& flights_;
    const real tickStart_;

    const Motion& motion(std::uint32_t row) const { return stage_.motions.rows[row]; }

    bool actOnBoth(Contact& c, int first, real t, real restitution);
    void actOnOne(Contact& c, int point, real t, real restitution);
    real frictionImpulse(Contact& c, const Moment& moment, real normalImpulse, real t);
    void applyAt(const Contact& c, const PlacedPoint& place, Vec2 impulse, real t);
    void record(Contact& c, const Moment& before, real normalImpulse, real tangentImpulse, real t,
                real restitution);
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
