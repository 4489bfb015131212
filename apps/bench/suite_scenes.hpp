// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

namespace tamias2d::bench {

Scene compounds();
Scene junkyard();
Scene largePyramid();
Scene manyPyramids();
Scene smash();
Scene washer();

}  // namespace tamias2d::bench
