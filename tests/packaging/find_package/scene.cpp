// SPDX-License-Identifier: MIT
// The scene layer from an installed library: a world is read from text and runs.

#include <tamias2d/scene/read.hpp>
#include <tamias2d/tamias2d.hpp>

#include <cstdio>

int main()
{
    using namespace tamias2d;
    Scene scene = openScene("pyramid:base=3");
    for (int i = 0; i < 60; ++i) scene.world->step();
    std::printf("%zu bodies\n", scene.world->bodyCount());
    return scene.world->bodyCount() >= 6 ? 0 : 1;
}
