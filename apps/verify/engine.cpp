// SPDX-License-Identifier: MIT
#include "engine.hpp"

#include <algorithm>
#include <cmath>

namespace tamias2d::verify {
namespace {

double tamiasGap(const SceneBody& a, const SceneBody& b)
{
    return 0.001 * std::min(a.width, b.width);
}

double chipmunkGap(const SceneBody&, const SceneBody&)
{
    return 0;
}

// Its polygons carry a skin of 10 mm and are let in by a slop of 5 mm (b2_common.h).
double box2dGap(const SceneBody& a, const SceneBody& b)
{
    const int skins = (a.outline == Outline::Polygon) + (b.outline == Outline::Polygon);
    return 0.01 * skins - 0.005;
}

constexpr EngineKind kEngines[] = {
    {"f64", "Tamias2D f64", "4 sub-steps", "double", true, true, makeTamiasF64, tamiasGap},
    {"f32", "Tamias2D f32", "4 sub-steps", "float", true, true, makeTamiasF32, tamiasGap},
    {"chipmunk", "Chipmunk 7.0.3", "10 iterations", "double", false, true, makeChipmunk, chipmunkGap},
    {"box2d", "Box2D 2.4.1", "8 velocity and 3 position iterations", "float", false, false, makeBox2D,
     box2dGap},
};

}  // namespace

std::span<const EngineKind> engines()
{
    return kEngines;
}

std::vector<Pull> pullsOn(const Scene& scene, const std::vector<State>& states, double t)
{
    std::vector<Pull> pulls(states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (scene.bodies[i].fixed) continue;
        if (scene.pull) pulls[i] = scene.pull(states[i], t);
        if (scene.gravitation == 0) continue;
        for (std::size_t k = 0; k < states.size(); ++k) {
            if (k == i) continue;
            const Vec d = states[k].position - states[i].position;
            const double r = length(d);
            const double f = scene.gravitation * scene.bodies[i].mass * scene.bodies[k].mass / (r * r * r);
            pulls[i].force = pulls[i].force + f * d;
        }
    }
    return pulls;
}

Trial::Trial(const EngineKind& kind, Scene scene) : scene_(std::move(scene)), engine_(kind.make(scene_)) {}

void Trial::step()
{
    engine_->step();
    ++steps_;
}

void Trial::run(double seconds)
{
    const auto count = std::lround(seconds * scene_.rate);
    for (long i = 0; i < count; ++i) step();
}

std::vector<State> Trial::states() const
{
    std::vector<State> all(scene_.bodies.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = engine_->state(i);
    return all;
}

}  // namespace tamias2d::verify
