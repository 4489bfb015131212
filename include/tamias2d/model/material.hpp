// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <cstdint>

namespace tamias2d::inline TAMIAS_PRECISION {

/// How the values of two materials become the value of their contact. If the two ask for
/// different rules, the one further down this list is taken.
enum class MixingRule : std::uint8_t {
    World,          ///< whatever the World says (the default of a material)
    Average,        ///< (a + b) / 2
    Minimum,        ///< the smaller
    Multiply,       ///< a b
    GeometricMean,  ///< sqrt(a b), the World's default for friction
    Maximum,        ///< the larger, the World's default for restitution
};

/// The surface of a shape [R3].
struct Material {
    real friction = real(0.6);    ///< Coulomb's coefficient                       [1]   >= 0
    real restitution = 0;         ///< C_R: speed apart over speed together [DD12] [1]   in [0, 1]
    real rollingResistance = 0;   ///< resisting torque over (normal force x rounding radius)  [1] >= 0
    real surfaceSpeed = 0;        ///< of a conveyor belt: how fast the surface runs counter-clockwise
                            ///< around the shape, i.e. to the left on its top  [m/s]
    MixingRule frictionMixing = MixingRule::World;
    MixingRule restitutionMixing = MixingRule::World;

    friend constexpr bool operator==(const Material&, const Material&) noexcept = default;
};

/// Which shapes meet. Two shapes collide if each one's mask holds the other's category; a shared
/// group that is not zero decides alone: positive always, negative never.
struct Filter {
    std::uint64_t category = 1;
    std::uint64_t mask = ~std::uint64_t{0};
    std::int32_t group = 0;

    friend constexpr bool operator==(const Filter&, const Filter&) noexcept = default;
};

constexpr bool shouldCollide(const Filter& a, const Filter& b) noexcept
{
    if (a.group != 0 && a.group == b.group) return a.group > 0;
    return (a.mask & b.category) != 0 && (b.mask & a.category) != 0;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
