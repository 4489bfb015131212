// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// A scene that any engine can build, in SI units and double precision, so that each engine gets exactly the
// same numbers.
namespace tamias2d::bench {

struct Vec {
    double x = 0;
    double y = 0;
};

/// Where a body is and how it moves; the position is that of its frame.
struct State {
    Vec position = {};  ///< [m]
    double angle = 0;  ///< [rad]
    Vec velocity = {};  ///< [m/s]
    double spin = 0;   ///< [rad/s]
};

/// What touches what: as in Box2D, two shapes of one group that is not 0 collide if it is above 0, others if
/// each has the other's category in its mask.
struct SceneFilter {
    unsigned category = 1;
    unsigned mask = ~0u;
    int group = 0;
};

/// A core of 1 (disc), 2 (capsule, or a line if the radius is 0) or more corners, rounded by a radius.
struct SceneShape {
    std::vector<Vec> corners = {};  ///< in the body's frame, counter-clockwise   [m]
    double radius = 0;         ///< [m]
    double density = 1;        ///< [kg/m^2]
    double friction = 0.6;
    double restitution = 0;
    SceneFilter filter = {};
};

enum class Mobility { Fixed, Driven, Free };

struct SceneBody {
    Mobility mobility = Mobility::Free;
    State start = {};
    bool asleep = false;  ///< at the start, in engines that know sleep
    std::vector<SceneShape> shapes = {};
    double damping = 0;    ///< c of exp(-c t), of the velocity   [1/s]
    bool maySleep = true;
    bool atStart = true;  ///< false: it comes as the scene is driven
};

/// A hinge: two points stay together. With bounds of its angle, a motor and a spring, as it has them; the
/// angle is that of B against A, less a reference.
struct SceneJoint {
    struct Limits {
        double lower, upper;  ///< [rad]
    };
    struct Motor {
        double speed, maxTorque;  ///< [rad/s], [N*m]: infinity for no bound
    };
    /// Towards the angle 0, as stiff as the two bodies would swing by their moments of inertia alone.
    struct Spring {
        double frequency, dampingRatio;  ///< [Hz], [1]
    };
    std::size_t a = 0, b = 0;  ///< bodies, a < b: it comes and goes with the later one
    Vec anchorA = {}, anchorB = {};  ///< in each body's frame   [m]
    double reference = 0;  ///< [rad]
    std::optional<Limits> limits = {};
    std::optional<Motor> motor = {};
    std::optional<Spring> spring = {};
};

class Engine;

struct Scene {
    std::string name;
    int steps = 0;
    Vec gravity = {0, -10};  ///< [m/s^2]
    bool sleep = false;      ///< may bodies fall asleep?
    std::vector<SceneBody> bodies = {};
    std::vector<SceneJoint> joints = {};  ///< in the order of their later bodies
    std::function<void(Engine&, int step)> drive = {};  ///< called before each step, if there is one
};

bool mayTouch(const SceneFilter& a, const SceneFilter& b);

/// Those that come and go with a body.
std::span<const SceneJoint> jointsOf(const Scene& scene, std::size_t body);

SceneShape disc(double radius);
SceneShape capsule(double halfLength, double radius);  ///< along x
SceneShape line(Vec a, Vec b);
SceneShape box(double halfWidth, double halfHeight, Vec center = {});
SceneShape polygon(std::vector<Vec> points);  ///< convex; in any order

/// A scene of the suite and what it is for.
struct SceneEntry {
    std::string_view name;
    std::string_view group;  ///< suite: of Box2D's benchmark; pile, small, world, gas: ours
    Scene (*make)();
};

const std::vector<SceneEntry>& scenes();

/// The same on every machine: uniform in [-1, 1).
class Random {
public:
    double next();

private:
    unsigned long long state_ = 2654435761u;
};

}  // namespace tamias2d::bench
