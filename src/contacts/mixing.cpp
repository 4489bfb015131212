// SPDX-License-Identifier: MIT
#include "contacts/mixing.hpp"

#include <tamias2d/math/scalar.hpp>

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {

real mixed(real a, real b, MixingRule ruleA, MixingRule ruleB, MixingRule worldRule) noexcept
{
    MixingRule rule = maximum(ruleA, ruleB);
    if (rule == MixingRule::World) rule = worldRule;
    switch (rule) {
    case MixingRule::Average:
        return (a + b) / 2;
    case MixingRule::Minimum:
        return minimum(a, b);
    case MixingRule::Multiply:
        return a * b;
    case MixingRule::GeometricMean:
        return std::sqrt(a * b);
    case MixingRule::World:
    case MixingRule::Maximum:
        break;
    }
    return maximum(a, b);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
