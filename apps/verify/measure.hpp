// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"

// What is read off a scene and its states, the same for every engine and by none of their code.
namespace tamias2d::verify {

/// m v^2 / 2 + I omega^2 / 2 of all moving bodies [J].
double kineticEnergy(const Scene& scene, const std::vector<State>& states);
/// -m g . p of all moving bodies [J].
double potentialEnergy(const Scene& scene, const std::vector<State>& states);

struct Momenta {
    Vec linear;                  ///< sum of m v                        [kg*m/s]
    double angular = 0;          ///< sum of m p x v + I omega          [kg*m^2/s]
    double linearMagnitude = 0;  ///< sum of the magnitudes, a scale for drifts
    double angularMagnitude = 0;
};
Momenta momenta(const Scene& scene, const std::vector<State>& states);

/// The fastest body: speed of the center plus that of the rim of its bounding circle [m/s].
double fastestBody(const Scene& scene, const std::vector<State>& states);

/// How far two shapes overlap [m]; 0 if they do not. Separating axes for polygons, closest
/// points for discs; exact for sharp polygons and discs.
double overlap(const SceneBody& a, const State& poseA, const SceneBody& b, const State& poseB);
/// The deepest overlap of any two bodies, fixed ones with moving ones included [m].
double deepestOverlap(const Scene& scene, const std::vector<State>& states);

/// The lowest corner of a polygon as seen along `up`: its point and index.
struct Extreme {
    Vec point;
    std::size_t corner = 0;
};
Extreme lowest(const SceneBody& polygon, const State& pose, Vec up);

}  // namespace tamias2d::verify
