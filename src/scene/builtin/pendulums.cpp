// SPDX-License-Identifier: MIT
#include "scene/builtin/builtins.hpp"
#include "scene/builtin/parts.hpp"

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

void preparePendulums(const Parameters& p, WorldDef&, SceneInfo& info)
{
    const double balls = p.integer("balls"), length = static_cast<double>(p.number("length"));
    info.seconds = 20;
    info.view = Aabb{{-length - 1, -1.5}, {balls + length, length + 1}};
}

void buildPendulums(const Parameters& p, World& world)
{
    const double length = static_cast<double>(p.number("length"));
    const double speed = static_cast<double>(p.number("speed"));
    const double gravity = -static_cast<double>(world.definition().gravity.y);
    // So high as to arrive with that speed, but no higher than the beam. Without gravity they start with it.
    const double high = gravity > 0 ? minimum(speed * speed / (2 * gravity), length) : 0;
    const double aside = std::sqrt(high * (2 * length - high));
    const double pitch = 1 + restGap(world, 1);
    const int balls = p.integer("balls"), strikers = minimum(p.integer("strikers"), balls);
    Body beam = addBody(world, "beam", BodyType::Static, {(balls - 1) * pitch / 2, length + 0.1},
                        makeBox(static_cast<real>(balls * pitch), real(0.2)), surface(0));
    for (int i = 0; i < balls; ++i) {
        const bool strikes = i < strikers;
        const Position rest{i * pitch, 0};
        Body ball =
            addBody(world, numbered("ball", i + 1).c_str(), BodyType::Dynamic,
                    strikes ? Position{rest.x - aside, high} : rest, Circle{{}, real(0.5)}, surface(0, 1));
        if (strikes && !(gravity > 0)) ball.setLinearVelocity({p.number("speed"), 0});
        world.createJoint(rodBetween(beam, ball, {rest.x, length}, ball.position()));
    }
}

}  // namespace

Builtin pendulumsScene()
{
    using enum BuiltinParameterType;
    return {
        {"pendulums",
         "Newton's cradle on strings",
         "Balls that hang in a row, struck from the left: as many swing out on the right, and the rest stay.",
         {{"balls", Integer, "5", 2, 50, {}, "in all, strikers included"},
          {"strikers", Integer, "1", 1, 25, {}, "how many strike"},
          {"length", Number, "4", 1, 100, {}, "of the strings [m]"},
          {"speed",
           Number,
           "4",
           0,
           100,
           {},
           "at which they strike; at most that of a fall from level [m/s]"}}},
        preparePendulums,
        buildPendulums};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
