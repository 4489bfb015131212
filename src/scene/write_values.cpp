// SPDX-License-Identifier: MIT
#include "scene/write_values.hpp"

#include <charconv>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

double shortest(float value)
{
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    double number = 0;
    std::from_chars(text, end, number);
    // Rounding twice, to double and then to float, may miss by one in rare cases: then all digits.
    return static_cast<float>(number) == value ? number : static_cast<double>(value);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
