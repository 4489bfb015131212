// SPDX-License-Identifier: MIT
// What the built-in scenes are put together from.
#pragma once

#include <tamias2d/world/world.hpp>

#include <cstdint>
#include <string>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

/// The gap at which two things rest, the smaller of which is `width` wide.   [m]
inline double restGap(const World& world, double width)
{
    return static_cast<double>(world.definition().tuning.restGap) * width;
}

inline Material surface(real friction, real restitution = 0)
{
    Material material;
    material.friction = friction;
    material.restitution = restitution;
    return material;
}

/// Adds a body of one shape, at rest.
inline Body addBody(World& world, const char* name, BodyType type, Position position,
                    const Geometry& geometry, const Material& material, double angle = 0)
{
    BodyDef def;
    def.name = name;
    def.type = type;
    def.position = position;
    def.angle = angle;
    ShapeDef shape;
    shape.geometry = geometry;
    shape.material = material;
    Body body = world.createBody(def);
    body.createShape(shape);
    return body;
}

/// A ground whose top is at y = 0, `width` wide and 1 m thick, about `x`.   [m]
inline Body addGround(World& world, double x, real width, const Material& material)
{
    return addBody(world, "ground", BodyType::Static, {x, -0.5}, makeBox(width, 1), material);
}

inline std::string numbered(const char* what, int number)
{
    return std::string(what) + " " + std::to_string(number);
}

/// Numbers that look random and are the same everywhere. The standard library's distributions are
/// not: each vendor draws them in its own way. (Steele, Lea, Flood: SplitMix, 2014.)
class Draw {
public:
    explicit Draw(int seed) : state_(static_cast<std::uint64_t>(seed)) {}

    /// Evenly in [-1, 1).
    double next()
    {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        z ^= z >> 31;
        return static_cast<double>(z >> 11) * 0x1p-52 - 1;
    }

private:
    std::uint64_t state_;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
