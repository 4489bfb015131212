// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/tamias2d.hpp>

#include <array>
#include <limits>

// Builders of test scenes: one line a body.
namespace tamias2d::test {

inline constexpr bool kDouble = std::numeric_limits<real>::digits > 24;

/// The tolerance of this build: `inDouble` in the f64 build, `inFloat` in the f32 build.
constexpr double byPrecision(double inDouble, double inFloat)
{
    return kDouble ? inDouble : inFloat;
}

/// What a few operations round, relative to their numbers; and what is left of that after ten seconds of
/// steps.
inline constexpr double kExact = byPrecision(1e-12, 1e-5);
inline constexpr double kTenSeconds = 10;
inline constexpr double kExactAfterTenSeconds = byPrecision(1e-12, 1e-4);

inline constexpr double kGravity = 9.81;  ///< [m/s^2] downwards, of a world that is told nothing else

/// A double as the real of this build.
constexpr real toReal(double x)
{
    return static_cast<real>(x);
}
constexpr Vec2 vec(double x, double y)
{
    return {toReal(x), toReal(y)};
}

/// What a test may want to say about a body beside its place and shape:
/// addBox(world, {0, 1}, 1, 1, {.velocity = vec(5, 0), .restitution = 1}).
struct Options {
    BodyType type = BodyType::Dynamic;
    Vec2 velocity = {};        ///< [m/s]
    double spin = 0;           ///< [rad/s]
    double angle = 0;          ///< [rad]
    double density = 1;        ///< [kg/m^2]
    double friction = 0.6;     ///< [1]
    double restitution = 0;    ///< [1]
    double rounding = 0;       ///< added outside a box or polygon   [m]
    double rollingResistance = 0;  ///< [1]
    double surfaceSpeed = 0;       ///< [m/s]
};

inline WorldDef withGravity(double x, double y)
{
    WorldDef def;
    def.gravity = vec(x, y);
    return def;
}
inline WorldDef weightless()
{
    return withGravity(0, 0);
}

/// A body of one shape. Both origins are at `position`.
inline Body addBody(World& world, Position position, const Geometry& geometry, const Options& options = {})
{
    BodyDef bodyDef;
    bodyDef.type = options.type;
    bodyDef.position = position;
    bodyDef.angle = options.angle;
    bodyDef.linearVelocity = options.velocity;
    bodyDef.angularVelocity = toReal(options.spin);
    Body body = world.createBody(bodyDef);
    ShapeDef shapeDef;
    shapeDef.geometry = geometry;
    shapeDef.density = toReal(options.density);
    shapeDef.material.friction = toReal(options.friction);
    shapeDef.material.restitution = toReal(options.restitution);
    shapeDef.material.rollingResistance = toReal(options.rollingResistance);
    shapeDef.material.surfaceSpeed = toReal(options.surfaceSpeed);
    body.createShape(shapeDef);
    return body;
}

/// A box of `width` by `height` [m] around `position`. A rounded one is that large in all, rounding included.
inline Body addBox(World& world, Position position, double width, double height, const Options& options = {})
{
    const double r = options.rounding;
    return addBody(world, position, makeBox(toReal(width - 2 * r), toReal(height - 2 * r), toReal(r)),
                   options);
}

inline Body addDisc(World& world, Position position, double radius, const Options& options = {})
{
    return addBody(world, position, Circle{{}, toReal(radius)}, options);
}

/// A lying capsule, `length` [m] from end to end.
inline Body addCapsule(World& world, Position position, double length, double radius,
                       const Options& options = {})
{
    const double half = length / 2 - radius;
    return addBody(world, position, Capsule{vec(-half, 0), vec(half, 0), toReal(radius)}, options);
}

inline Body addRegular(World& world, Position position, int corners, double circumradius,
                       const Options& options = {})
{
    return addBody(world, position,
                   makeRegularPolygon(corners, toReal(circumradius), toReal(options.rounding)), options);
}

/// A static box of `width` [m] whose top is at height `top`, centered at x = 0 and 1 m thick.
inline Body addGround(World& world, double top = 0, double width = 100, Options options = {})
{
    options.type = BodyType::Static;
    return addBox(world, {0, top - 0.5}, width, 1, options);
}

/// Four static boxes, each 1 m thick, around the room from `lower` to `upper`: left, right, below, above.
inline std::array<Body, 4> addWalls(World& world, Position lower, Position upper, Options options = {})
{
    options.type = BodyType::Static;
    const double width = upper.x - lower.x, height = upper.y - lower.y;
    const double middleX = (lower.x + upper.x) / 2, middleY = (lower.y + upper.y) / 2;
    return {addBox(world, {lower.x - 0.5, middleY}, 1, height + 2, options),
            addBox(world, {upper.x + 0.5, middleY}, 1, height + 2, options),
            addBox(world, {middleX, lower.y - 0.5}, width + 2, 1, options),
            addBox(world, {middleX, upper.y + 0.5}, width + 2, 1, options)};
}

/// The size of a static body: the rest gap then follows the other one.
inline constexpr double kImmovable = std::numeric_limits<double>::infinity();

/// The gap at which two bodies of these smallest widths rest [m]: boxes placed at it start calm.
inline double restGapFor(const World& world, double sizeA, double sizeB = kImmovable)
{
    return static_cast<double>(world.definition().tuning.restGap) * minimum(sizeA, sizeB);
}

}  // namespace tamias2d::test
