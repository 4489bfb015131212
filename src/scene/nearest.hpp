// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

/// For the end of a rule about an unknown word: `; did you mean "friction"?` if one of the known
/// words is near, else `; known: a, b, c`.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
