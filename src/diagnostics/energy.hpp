// SPDX-License-Identifier: MIT
#pragma once

#include "forces/accelerations.hpp"
#include "model/bodies.hpp"

#include <tamias2d/diagnostics/energy.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Of one body; zero unless it is dynamic [DD15, DD16]. Gravitation between bodies is left out.
Energy energyOf(const BodyTable& bodies, std::uint32_t slot, const ForceField& field, double time);
Momentum momentumOf(const BodyRow& body);

/// Of all enabled dynamic bodies, gravitation between them included.
Energy totalEnergy(const BodyTable& bodies, const ForceField& field, double time);
Momentum totalMomentum(const BodyTable& bodies);

}  // namespace tamias2d::inline TAMIAS_PRECISION
