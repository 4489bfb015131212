// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/math/transform.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Energy of one body or of all dynamic bodies [DD15, DD16]. Always double.
struct Energy {
    double linear = 0;      ///< m v^2 / 2          [J]
    double rotational = 0;  ///< I omega^2 / 2      [J]
    double potential =
        0;   ///< -m g . p, plus that of gravitation, of laws that state one, of joints' springs   [J]

    double kinetic() const noexcept { return linear + rotational; }
    double total() const noexcept { return linear + rotational + potential; }
};

/// Momentum of one body or of all dynamic bodies [GD1]. Always double.
struct Momentum {
    DVec2 linear;        ///< sum of m v                                        [kg*m/s]
    double angular = 0;  ///< sum of m p x v + I omega, about the world origin  [kg*m^2/s]
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
