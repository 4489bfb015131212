// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

// A scene that any engine can build: one shape a body, in SI units and double precision. The
// experiments speak of these types only, so each engine gets exactly the same numbers.
namespace tamias2d::verify {

struct Vec {
    double x = 0;
    double y = 0;
};
inline Vec operator+(Vec a, Vec b)
{
    return {a.x + b.x, a.y + b.y};
}
inline Vec operator-(Vec a, Vec b)
{
    return {a.x - b.x, a.y - b.y};
}
inline Vec operator*(double s, Vec a)
{
    return {s * a.x, s * a.y};
}
inline double dot(Vec a, Vec b)
{
    return a.x * b.x + a.y * b.y;
}
inline double cross(Vec a, Vec b)
{
    return a.x * b.y - a.y * b.x;
}
double length(Vec a);
Vec turned(Vec a, double angle);

/// Where a body is and how it moves. All shapes are centered, so position is the center of mass.
struct State {
    Vec position;      ///< [m]
    double angle = 0;  ///< [rad]
    Vec velocity;      ///< [m/s]
    double spin = 0;   ///< [rad/s]
};

enum class Outline { Disc, Polygon };

struct SceneBody {
    bool fixed = false;  ///< never moves
    bool fast = false;   ///< asks an engine that wants to be asked for continuous collision
    double mass = 1;     ///< [kg]
    double inertia = 1;  ///< [kg*m^2]
    State start;
    Outline outline = Outline::Disc;
    double radius = 0.5;       ///< of the disc, or of the polygon's rounding   [m]
    std::vector<Vec> corners;  ///< of a polygon, counter-clockwise             [m]
    double width = 1;          ///< its smaller one                             [m]
};

/// What acts on a body besides the scene's gravity.
struct Pull {
    Vec force;          ///< [N]
    double torque = 0;  ///< [N*m]
};
using PullLaw = std::function<Pull(const State& state, double t)>;

struct Scene {
    std::vector<SceneBody> bodies;
    Vec gravity = {0, -9.81};  ///< [m/s^2]
    double friction = 0.6;     ///< of every pair
    double restitution = 0;    ///< of every pair
    double damping = 0;        ///< c of exp(-c t), of both velocities   [1/s]
    double gravitation = 0;    ///< G between all bodies                 [m^3/(kg*s^2)]
    double rate = 60;          ///< steps a second
    int substeps = 4;          ///< of Tamias2D; the others have none
    PullLaw pull;              ///< on every body that is not fixed; none if empty

    std::size_t add(SceneBody body)
    {
        bodies.push_back(std::move(body));
        return bodies.size() - 1;
    }
};

// Bodies of density 1 kg/m^2.
SceneBody disc(double radius, Vec position, Vec velocity = {}, double spin = 0);
SceneBody box(double width, double height, Vec position, double angle = 0, Vec velocity = {},
              double spin = 0);
SceneBody roundedBox(double size, double rounding, Vec position);
SceneBody hexagon(double circumradius, Vec position);
SceneBody fixedBox(double width, double height, Vec position, double angle = 0);

/// The same on every machine: uniform in [-1, 1).
class Random {
public:
    explicit Random(unsigned seed) : state_(seed * 2654435761u + 1u) {}
    double next();

private:
    unsigned long long state_;
};

}  // namespace tamias2d::verify
