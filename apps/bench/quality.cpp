// SPDX-License-Identifier: MIT
#include "quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tamias2d::bench {
namespace {

// A shape where it is now.
struct Placed {
    std::vector<Vec> corners;
    double radius;
    double left, right, bottom, top;
    std::size_t body;
    SceneFilter filter;
};

Vec minus(Vec a, Vec b)
{
    return {a.x - b.x, a.y - b.y};
}
double dot(Vec a, Vec b)
{
    return a.x * b.x + a.y * b.y;
}
double cross(Vec a, Vec b)
{
    return a.x * b.y - a.y * b.x;
}

Vec toWorld(const State& state, Vec v)
{
    const double c = std::cos(state.angle), s = std::sin(state.angle);
    return {state.position.x + c * v.x - s * v.y, state.position.y + s * v.x + c * v.y};
}

Placed place(const SceneShape& shape, const State& state, std::size_t body)
{
    Placed placed{{}, shape.radius, 1e300, -1e300, 1e300, -1e300, body, shape.filter};
    for (Vec v : shape.corners) {
        const Vec p = toWorld(state, v);
        placed.corners.push_back(p);
        placed.left = std::min(placed.left, p.x - shape.radius);
        placed.right = std::max(placed.right, p.x + shape.radius);
        placed.bottom = std::min(placed.bottom, p.y - shape.radius);
        placed.top = std::max(placed.top, p.y + shape.radius);
    }
    return placed;
}

// Greatest distance of `b` in front of a face of `a`, a line having two; -infinity if `a` is a point.
double faceDistance(const Placed& a, const Placed& b)
{
    const std::size_t n = a.corners.size();
    double greatest = -std::numeric_limits<double>::infinity();
    if (n < 2) return greatest;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec edge = minus(a.corners[(i + 1) % n], a.corners[i]);
        const double length = std::sqrt(dot(edge, edge));
        double least = std::numeric_limits<double>::infinity(), before = least;
        for (Vec p : b.corners) {
            const Vec d = minus(p, a.corners[i]);
            least = std::min(least, -cross(edge, d) / length);
            before = std::min(before, -dot(edge, d) / length);
        }
        greatest = std::max(greatest, least);
        if (n == 2) greatest = std::max(greatest, before);  // beyond an end of the line
    }
    return greatest;
}

// Least distance of a corner of `b` from an edge of `a`.
double cornerDistance(const Placed& a, const Placed& b)
{
    const std::size_t n = a.corners.size();
    double least = std::numeric_limits<double>::infinity();
    for (Vec p : b.corners) {
        for (std::size_t i = 0; i < n; ++i) {
            const Vec edge = minus(a.corners[(i + 1) % n], a.corners[i]), d = minus(p, a.corners[i]);
            const double squared = dot(edge, edge);
            const double along = squared > 0 ? std::clamp(dot(edge, d) / squared, 0.0, 1.0) : 0;
            const Vec gap = minus(d, {along * edge.x, along * edge.y});
            least = std::min(least, std::sqrt(dot(gap, gap)));
        }
    }
    return least;
}

double overlap(const Placed& a, const Placed& b)
{
    const double byFace = std::max(faceDistance(a, b), faceDistance(b, a));
    const double distance =
        byFace < 0 && std::isfinite(byFace) ? byFace : std::min(cornerDistance(a, b), cornerDistance(b, a));
    return a.radius + b.radius - distance;
}

// Mass and moment of inertia about the frame, center of mass: fans of triangles, discs and strips.
struct Mass {
    double mass = 0, inertia = 0;
    Vec moment;
};

Mass massOf(const SceneBody& body)
{
    Mass sum;
    const auto add = [&](double mass, Vec center, double inertia) {
        sum.mass += mass;
        sum.moment = {sum.moment.x + mass * center.x, sum.moment.y + mass * center.y};
        sum.inertia += inertia + mass * dot(center, center);
    };
    for (const SceneShape& shape : body.shapes) {
        const std::vector<Vec>& c = shape.corners;
        const double r = shape.radius, pi = std::numbers::pi;
        for (std::size_t i = 1; i + 1 < c.size(); ++i) {
            const Vec u = minus(c[i], c[0]), v = minus(c[i + 1], c[0]);
            const double mass = shape.density * cross(u, v) / 2;
            const Vec center{c[0].x + (u.x + v.x) / 3, c[0].y + (u.y + v.y) / 3};
            add(mass, center, mass / 18 * (dot(u, u) + dot(v, v) - dot(u, v)));
        }
        if (c.size() == 1) add(shape.density * pi * r * r, c[0], shape.density * pi * r * r * r * r / 2);
        if (c.size() != 2) continue;
        const double length = std::sqrt(dot(minus(c[1], c[0]), minus(c[1], c[0])));
        const double strip = shape.density * 2 * r * length, ends = shape.density * pi * r * r;
        const double offset = length / 2 + 4 * r / (3 * pi), squared = 4 * r / (3 * pi);
        add(strip + ends, {(c[0].x + c[1].x) / 2, (c[0].y + c[1].y) / 2},
            strip * (length * length + 4 * r * r) / 12 +
                ends * (r * r / 2 - squared * squared + offset * offset));
    }
    return sum;
}

void addEnergy(const SceneBody& body, const State& s, Quality& quality)
{
    const Mass m = massOf(body);
    if (!(m.mass > 0)) return;
    const Vec center{m.moment.x / m.mass, m.moment.y / m.mass};
    const double inertia = m.inertia - m.mass * dot(center, center);
    const double squared = dot(s.velocity, s.velocity);
    quality.kineticEnergy += m.mass / 2 * squared + inertia / 2 * s.spin * s.spin;
    quality.fastest = std::max(quality.fastest, std::sqrt(squared));
    quality.top = std::max(quality.top, s.position.y);
}

}  // namespace

Quality measureQuality(const Scene& scene, const Engine& engine)
{
    Quality quality;
    std::vector<Placed> movers, others;
    quality.top = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (!engine.has(i)) continue;
        const SceneBody& body = scene.bodies[i];
        const State state = engine.state(i);
        const bool isFree = body.mobility == Mobility::Free;
        for (const SceneShape& shape : body.shapes)
            (isFree ? movers : others).push_back(place(shape, state, i));
        if (isFree) addEnergy(body, state, quality);
        for (const SceneJoint& joint : jointsOf(scene, i)) {
            const Vec gap =
                minus(toWorld(state, joint.anchorB), toWorld(engine.state(joint.a), joint.anchorA));
            quality.jointError = std::max(quality.jointError, std::sqrt(dot(gap, gap)));
        }
    }
    const auto byLeft = [](const Placed& a, const Placed& b) { return a.left < b.left; };
    std::sort(movers.begin(), movers.end(), byLeft);
    std::sort(others.begin(), others.end(), byLeft);

    double sum = 0, count = 0;
    const auto follow = [&](const Placed& one, const std::vector<Placed>& list, auto next) {
        for (; next != list.end() && next->left <= one.right; ++next) {
            if (next->body == one.body || next->bottom > one.top || next->top < one.bottom) continue;
            if (!mayTouch(one.filter, next->filter)) continue;
            const double depth = overlap(one, *next);
            if (!(depth > 0)) continue;
            quality.deepest = std::max(quality.deepest, depth);
            sum += depth;
            ++count;
        }
    };
    for (auto it = movers.begin(); it != movers.end(); ++it) {
        follow(*it, movers, it + 1);
        follow(*it, others, std::lower_bound(others.begin(), others.end(), *it, byLeft));
    }
    for (const Placed& other : others)
        follow(other, movers, std::upper_bound(movers.begin(), movers.end(), other, byLeft));
    quality.mean = count > 0 ? sum / count : 0;
    return quality;
}

}  // namespace tamias2d::bench
