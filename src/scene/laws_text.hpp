// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/scene/read.hpp>

#include "scene/read_values.hpp"
#include "scene/write_values.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

/// Reads the key "law" and the parameters of a law: one of the library's by its name, else one of
/// `registry`. Other keys are the caller's to read and to finish().
ForceLaw readLaw(ObjectReader& in, const std::vector<ForceLaw>& registry);

/// A law's name, and its parameters if it is one of the library's.
OrderedJson lawJson(const ForceLaw& law);

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
