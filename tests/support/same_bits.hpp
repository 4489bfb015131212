// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <cmath>

namespace tamias2d::test {

/// Equal in all bits; two NaN count as equal.
inline bool sameBits(real a, real b)
{
    return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

}  // namespace tamias2d::test
