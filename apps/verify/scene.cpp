// SPDX-License-Identifier: MIT
#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tamias2d::verify {

double length(Vec a)
{
    return std::hypot(a.x, a.y);
}

Vec turned(Vec a, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * a.x - s * a.y, s * a.x + c * a.y};
}

SceneBody disc(double radius, Vec position, Vec velocity, double spin)
{
    SceneBody body;
    body.mass = std::numbers::pi * radius * radius;
    body.inertia = body.mass * radius * radius / 2;
    body.start = {position, 0, velocity, spin};
    body.radius = radius;
    body.width = 2 * radius;
    return body;
}

SceneBody box(double width, double height, Vec position, double angle, Vec velocity, double spin)
{
    SceneBody body;
    body.mass = width * height;
    body.inertia = body.mass * (width * width + height * height) / 12;
    body.start = {position, angle, velocity, spin};
    body.outline = Outline::Polygon;
    body.radius = 0;
    const double x = width / 2, y = height / 2;
    body.corners = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    body.width = std::min(width, height);
    return body;
}

// Its mass is that of the outer square: all engines are given the same figure, so it need not be exact.
SceneBody roundedBox(double size, double rounding, Vec position)
{
    SceneBody body = box(size - 2 * rounding, size - 2 * rounding, position);
    body.radius = rounding;
    body.mass = size * size;
    body.inertia = body.mass * size * size / 6;
    body.width = size;
    return body;
}

SceneBody hexagon(double circumradius, Vec position)
{
    SceneBody body = box(1, 1, position);
    body.corners.clear();
    for (int i = 0; i < 6; ++i) body.corners.push_back(turned({circumradius, 0}, i * std::numbers::pi / 3));
    const double r2 = circumradius * circumradius;
    body.mass = 1.5 * std::numbers::sqrt3 * r2;
    body.inertia = body.mass * r2 * 5 / 12;
    body.width = std::numbers::sqrt3 * circumradius;
    return body;
}

SceneBody fixedBox(double width, double height, Vec position, double angle)
{
    SceneBody body = box(width, height, position, angle);
    body.fixed = true;
    return body;
}

// Knuth's MMIX generator; its upper bits are good enough to scatter bodies.
double Random::next()
{
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state_ >> 33) / 1073741824.0 - 1.0;
}

}  // namespace tamias2d::verify
