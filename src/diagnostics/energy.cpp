// SPDX-License-Identifier: MIT
#include "diagnostics/energy.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

Energy energyOf(const BodyTable& bodies, std::uint32_t slot, const ForceField& field, double time)
{
    const BodyRow& body = bodies.rows[slot];
    Energy energy;
    if (!body.isDynamic()) return energy;
    const DVec2 v = toDVec2(body.velocity);
    const double spin = static_cast<double>(body.spin);
    energy.linear = static_cast<double>(body.mass) * dot(v, v) / 2;
    energy.rotational = static_cast<double>(body.inertia) * spin * spin / 2;
    energy.potential = potentialEnergy(bodies, slot, field, time);
    return energy;
}

Momentum momentumOf(const BodyRow& body)
{
    Momentum momentum;
    if (!body.isDynamic()) return momentum;
    const DVec2 p = static_cast<double>(body.mass) * toDVec2(body.velocity);
    momentum.linear = p;
    momentum.angular = cross(DVec2{body.center.x, body.center.y}, p) +
                       static_cast<double>(body.inertia) * static_cast<double>(body.spin);
    return momentum;
}

Energy totalEnergy(const BodyTable& bodies, const ForceField& field, double time)
{
    Energy sum;
    for (std::uint32_t i = 0; i < bodies.rows.size(); ++i) {
        if (!bodies.ids.isAlive(i) || !bodies.rows[i].enabled) continue;
        const Energy one = energyOf(bodies, i, field, time);
        sum.linear += one.linear;
        sum.rotational += one.rotational;
        sum.potential += one.potential;
    }
    sum.potential += gravitationEnergy(bodies, field.gravitationConstant);
    return sum;
}

Momentum totalMomentum(const BodyTable& bodies)
{
    Momentum sum;
    for (std::uint32_t i = 0; i < bodies.rows.size(); ++i) {
        if (!bodies.ids.isAlive(i) || !bodies.rows[i].enabled) continue;
        const Momentum one = momentumOf(bodies.rows[i]);
        sum.linear += one.linear;
        sum.angular += one.angular;
    }
    return sum;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
