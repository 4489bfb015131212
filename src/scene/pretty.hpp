// SPDX-License-Identifier: MIT
#pragma once

#include "scene/write_values.hpp"

#include <string>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

/// JSON as a person would lay it out: what fits on a line stands on one.
std::string prettyText(const OrderedJson& value);

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
