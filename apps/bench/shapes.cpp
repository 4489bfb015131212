// SPDX-License-Identifier: MIT
#include "scene.hpp"

#include <algorithm>
#include <cmath>

namespace tamias2d::bench {

double Random::next()
{
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1;
}

SceneShape disc(double radius)
{
    return {{{}}, radius};
}

SceneShape capsule(double halfLength, double radius)
{
    return {{{-halfLength, 0}, {halfLength, 0}}, radius};
}

SceneShape line(Vec a, Vec b)
{
    return {{a, b}};
}

SceneShape box(double halfWidth, double halfHeight, Vec c)
{
    return {{{c.x - halfWidth, c.y - halfHeight},
             {c.x + halfWidth, c.y - halfHeight},
             {c.x + halfWidth, c.y + halfHeight},
             {c.x - halfWidth, c.y + halfHeight}}};
}

SceneShape polygon(std::vector<Vec> points)
{
    Vec middle;
    for (Vec p : points) middle = {middle.x + p.x, middle.y + p.y};
    const double n = static_cast<double>(points.size());
    middle = {middle.x / n, middle.y / n};
    std::sort(points.begin(), points.end(), [&](Vec a, Vec b) {
        return std::atan2(a.y - middle.y, a.x - middle.x) < std::atan2(b.y - middle.y, b.x - middle.x);
    });
    return {std::move(points)};
}

bool mayTouch(const SceneFilter& a, const SceneFilter& b)
{
    if (a.group != 0 && a.group == b.group) return a.group > 0;
    return (a.mask & b.category) != 0 && (b.mask & a.category) != 0;
}

std::span<const SceneJoint> jointsOf(const Scene& scene, std::size_t body)
{
    return std::ranges::equal_range(scene.joints, body, {}, &SceneJoint::b);
}

}  // namespace tamias2d::bench
