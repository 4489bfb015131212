// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

namespace tamias2d::bench {

Scene compounds();
Scene jointGrid();
Scene junkyard();
Scene largePyramid();
Scene manyPyramids();
Scene rain();
Scene smash();
Scene spinner();
Scene tumbler();
Scene washer();

}  // namespace tamias2d::bench
