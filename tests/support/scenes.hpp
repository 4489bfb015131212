// SPDX-License-Identifier: MIT
#pragma once

#include <support/build.hpp>
#include <support/random.hpp>
#include <support/traces.hpp>

#include <cstdio>
#include <string>
#include <vector>

// Scenes of many boxes: floors of tiles, stacks, pyramids, bins. Boxes are 1 m wide unless said, and are
// put at the rest gap, so that nothing has to fall before it carries.
namespace tamias2d::test {

/// A figure for the report, asserted or not: it arrives in the XML beside pass or fail.
inline void record(const std::string& what, double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    testing::Test::RecordProperty(what, text);
}

/// A body and where it was put.
struct Placed {
    Body body;
    Position start;

    double sideways() const { return std::abs(body.centerOfMass().x - start.x); }  ///< [m]
    double sunk() const { return start.y - body.centerOfMass().y; }                ///< [m]
};

/// How far the one that went furthest has gone sideways [m].
inline double furthestSideways(const std::vector<Placed>& boxes)
{
    double furthest = 0;
    for (const Placed& box : boxes) furthest = std::max(furthest, box.sideways());
    return furthest;
}

/// `count` boxes one upon the other at `x`, each off its place by up to `offset` [m] to either side.
inline std::vector<Placed> addStack(World& world, int count, double x = 0, double offset = 0,
                                    std::uint32_t seed = 1)
{
    const double gap = restGapFor(world, 1);
    Random random(seed);
    std::vector<Placed> boxes;
    for (int i = 0; i < count; ++i) {
        const Position at{x + random.between(-offset, offset), 0.5 + gap + i * (1 + gap)};
        boxes.push_back({addBox(world, at, 1, 1), at});
    }
    return boxes;
}

/// A pyramid of boxes 5 cm apart, `base` of them in the lowest row; the last one added is the top.
inline std::vector<Placed> addPyramid(World& world, int base)
{
    const double gap = restGapFor(world, 1);
    std::vector<Placed> boxes;
    for (int row = 0; row < base; ++row) {
        for (int i = 0; i < base - row; ++i) {
            const Position at{(i - (base - row - 1) / 2.0) * 1.05, 0.5 + gap + row * (1 + gap)};
            boxes.push_back({addBox(world, at, 1, 1), at});
        }
    }
    return boxes;
}

/// A bin 10 m wide, open at the top, its floor at height 0.
inline void addBin(World& world, const Options& surface)
{
    Options fixed = surface;
    fixed.type = BodyType::Static;
    addBox(world, {0, -1}, 16, 2, fixed);
    addBox(world, {-6, 29}, 2, 60, fixed);
    addBox(world, {6, 29}, 2, 60, fixed);
}

/// `count` bodies of 0.4 to 0.8 m in loose rows of eight above the bin, turned at random: boxes, and with
/// `discs` every third one a disc.
inline std::vector<Body> addHail(World& world, int count, bool discs, std::uint32_t seed, Options surface)
{
    Random random(seed);
    std::vector<Body> bodies;
    for (int i = 0; i < count; ++i) {
        const double half = random.between(0.2, 0.4);
        const Position at{(i % 8 - 3.5) * 1.1 + random.between(-0.1, 0.1), 1 + (i / 8) * 1.2};
        surface.angle = random.between(-1, 1);
        bodies.push_back(discs && i % 3 == 0 ? addDisc(world, at, half, surface)
                                             : addBox(world, at, 2 * half, 1.4 * half, surface));
    }
    return bodies;
}

/// A floor of 200 tiles of 1 m, the first centered at x = 0, tops at height 0. `Off` draws them apart or
/// over each other by up to that much.
struct Tiles {
    bool segments = false;     ///< lines instead of boxes
    bool oneBody = false;      ///< all shapes on one body instead of a body each
    double off = 0;            ///< by how much each is off its place, either way   [m]
    double uneven = 0;         ///< by how much each is too high or too low         [m]
    double step = 0;           ///< how much higher the tiles from number 100 on lie   [m]
    double friction = 0;       ///< [1]
    double restitution = 0;    ///< [1]
};

inline void addTiles(World& world, const Tiles& tiles)
{
    BodyDef bodyDef;
    bodyDef.type = BodyType::Static;
    ShapeDef shapeDef;
    shapeDef.material.friction = toReal(tiles.friction);
    shapeDef.material.restitution = toReal(tiles.restitution);
    if (tiles.segments)
        shapeDef.geometry = Segment{vec(-0.5, 0), vec(0.5, 0)};
    else
        shapeDef.geometry = makeBox(1, 1);
    const double depth = tiles.segments ? 0 : 0.5;
    Random random(3);
    Body floor;
    if (tiles.oneBody) floor = world.createBody(bodyDef);
    for (int i = 0; i < 200; ++i) {
        Position at{i + random.between(-tiles.off, tiles.off), (i < 100 ? 0 : tiles.step) - depth};
        if (tiles.uneven > 0) at.y += random.between(-tiles.uneven, tiles.uneven);
        if (tiles.oneBody) {
            shapeDef.offset = vec(at.x, at.y);
        } else {
            bodyDef.position = at;
            floor = world.createBody(bodyDef);
        }
        floor.createShape(shapeDef);
    }
}

}  // namespace tamias2d::test
