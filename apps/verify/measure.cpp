// SPDX-License-Identifier: MIT
#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tamias2d::verify {
namespace {

std::vector<Vec> cornersInWorld(const SceneBody& body, const State& pose);
double outerRadius(const SceneBody& body);

}  // namespace

double kineticEnergy(const Scene& scene, const std::vector<State>& states)
{
    double sum = 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const SceneBody& b = scene.bodies[i];
        if (b.fixed) continue;
        sum += (b.mass * dot(states[i].velocity, states[i].velocity) +
                b.inertia * states[i].spin * states[i].spin) /
               2;
    }
    return sum;
}

double potentialEnergy(const Scene& scene, const std::vector<State>& states)
{
    double sum = 0;
    for (std::size_t i = 0; i < states.size(); ++i)
        if (!scene.bodies[i].fixed) sum -= scene.bodies[i].mass * dot(scene.gravity, states[i].position);
    return sum;
}

Momenta momenta(const Scene& scene, const std::vector<State>& states)
{
    Momenta sum;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const SceneBody& b = scene.bodies[i];
        if (b.fixed) continue;
        const Vec p = b.mass * states[i].velocity;
        const double orbital = cross(states[i].position, p), own = b.inertia * states[i].spin;
        sum.linear = sum.linear + p;
        sum.angular += orbital + own;
        sum.linearMagnitude += length(p);
        sum.angularMagnitude += std::fabs(orbital) + std::fabs(own);
    }
    return sum;
}

double fastestBody(const Scene& scene, const std::vector<State>& states)
{
    double fastest = 0;
    for (std::size_t i = 0; i < states.size(); ++i)
        if (!scene.bodies[i].fixed)
            fastest = std::max(fastest, length(states[i].velocity) +
                                            std::fabs(states[i].spin) * outerRadius(scene.bodies[i]));
    return fastest;
}

namespace {

std::vector<Vec> cornersInWorld(const SceneBody& body, const State& pose)
{
    std::vector<Vec> corners;
    const Vec x = turned({1, 0}, pose.angle), y = {-x.y, x.x};
    for (Vec c : body.corners) corners.push_back(pose.position + c.x * x + c.y * y);
    return corners;
}

double outerRadius(const SceneBody& body)
{
    double r = 0;
    for (Vec c : body.corners) r = std::max(r, length(c));
    return r + body.radius;
}

// The largest distance of polygon b in front of an edge of polygon a: < 0 if every edge cuts into b.
double edgeSeparation(const std::vector<Vec>& a, const std::vector<Vec>& b)
{
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec edge = a[(i + 1) % a.size()] - a[i];
        const Vec normal = 1 / length(edge) * Vec{edge.y, -edge.x};
        double nearest = std::numeric_limits<double>::infinity();
        for (Vec p : b) nearest = std::min(nearest, dot(normal, p - a[i]));
        best = std::max(best, nearest);
    }
    return best;
}

// From a point to a polygon: < 0 inside.
double pointSeparation(const std::vector<Vec>& polygon, Vec p)
{
    const double inside = edgeSeparation(polygon, {p});
    if (inside <= 0) return inside;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec a = polygon[i], edge = polygon[(i + 1) % polygon.size()] - a;
        const double t = std::clamp(dot(p - a, edge) / dot(edge, edge), 0.0, 1.0);
        nearest = std::min(nearest, length(p - a - t * edge));
    }
    return nearest;
}

}  // namespace

double overlap(const SceneBody& a, const State& poseA, const SceneBody& b, const State& poseB)
{
    const double radii = a.radius + b.radius;
    double separation = 0;
    if (a.outline == Outline::Disc && b.outline == Outline::Disc)
        separation = length(poseB.position - poseA.position);
    else if (a.outline == Outline::Disc)
        separation = pointSeparation(cornersInWorld(b, poseB), poseA.position);
    else if (b.outline == Outline::Disc)
        separation = pointSeparation(cornersInWorld(a, poseA), poseB.position);
    else {
        const auto cornersA = cornersInWorld(a, poseA), cornersB = cornersInWorld(b, poseB);
        separation = std::max(edgeSeparation(cornersA, cornersB), edgeSeparation(cornersB, cornersA));
    }
    return std::max(0.0, radii - separation);
}

double deepestOverlap(const Scene& scene, const std::vector<State>& states)
{
    struct Bounds {
        double left, right, bottom, top;
        std::size_t body;
    };
    std::vector<Bounds> bounds;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const double r = scene.bodies[i].radius;
        Vec low = states[i].position, high = low;
        for (Vec c : cornersInWorld(scene.bodies[i], states[i])) {
            low = {std::min(low.x, c.x), std::min(low.y, c.y)};
            high = {std::max(high.x, c.x), std::max(high.y, c.y)};
        }
        bounds.push_back({low.x - r, high.x + r, low.y - r, high.y + r, i});
    }
    std::sort(bounds.begin(), bounds.end(), [](const Bounds& a, const Bounds& b) { return a.left < b.left; });
    double deepest = 0;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        for (std::size_t k = i + 1; k < bounds.size() && bounds[k].left <= bounds[i].right; ++k) {
            const std::size_t a = bounds[i].body, b = bounds[k].body;
            if (bounds[i].bottom > bounds[k].top || bounds[k].bottom > bounds[i].top) continue;
            if (scene.bodies[a].fixed && scene.bodies[b].fixed) continue;
            deepest = std::max(deepest, overlap(scene.bodies[a], states[a], scene.bodies[b], states[b]));
        }
    }
    return deepest;
}

Extreme lowest(const SceneBody& polygon, const State& pose, Vec up)
{
    const auto corners = cornersInWorld(polygon, pose);
    Extreme found{corners[0], 0};
    for (std::size_t i = 1; i < corners.size(); ++i)
        if (dot(up, corners[i]) < dot(up, found.point)) found = {corners[i], i};
    return found;
}

}  // namespace tamias2d::verify
