// SPDX-License-Identifier: MIT
#include "engine.hpp"

#include <tamias2d/tamias2d.hpp>

// Tamias2D with its defaults. This file is compiled twice, once a precision.
namespace tamias2d::verify {
namespace {

Vec2 toReal(Vec v)
{
    return {static_cast<real>(v.x), static_cast<real>(v.y)};
}

WorldDef worldOf(const Scene& scene)
{
    WorldDef def;
    def.gravity = toReal(scene.gravity);
    def.gravitationConstant = static_cast<real>(scene.gravitation);
    return def;
}

class TamiasEngine final : public Engine {
public:
    explicit TamiasEngine(const Scene& scene)
        : dt_(1 / scene.rate), substeps_(scene.substeps), world_(worldOf(scene))
    {
        for (const SceneBody& body : scene.bodies) add(scene, body);
        if (!scene.pull) return;
        ForceLaw law;
        law.name = "pull";
        law.force = [pull = scene.pull](const BodyView& b, double t) {
            const State state{{b.center.x, b.center.y}, b.angle, {b.velocity.x, b.velocity.y}, b.spin};
            const Pull p = pull(state, t);
            return Wrench{{p.force.x, p.force.y}, p.torque};
        };
        world_.addForceLaw(law);
    }

    void step() override { world_.step(dt_, substeps_); }

    State state(std::size_t i) const override
    {
        const Body& body = bodies_[i];
        const Position p = body.centerOfMass();
        const Vec2 v = body.linearVelocity();
        return {{p.x, p.y}, body.angle(), {v.x, v.y}, body.angularVelocity()};
    }

private:
    void add(const Scene& scene, const SceneBody& source)
    {
        BodyDef def;
        def.type = source.fixed ? BodyType::Static : BodyType::Dynamic;
        def.position = {source.start.position.x, source.start.position.y};
        def.angle = source.start.angle;
        def.linearVelocity = toReal(source.start.velocity);
        def.angularVelocity = static_cast<real>(source.start.spin);
        def.linearDamping = def.angularDamping = static_cast<real>(scene.damping);
        if (!source.fixed)
            def.mass = MassProperties{static_cast<real>(source.mass), {}, static_cast<real>(source.inertia)};
        Body body = world_.createBody(def);
        ShapeDef shape;
        if (source.outline == Outline::Disc) {
            shape.geometry = Circle{{}, static_cast<real>(source.radius)};
        } else {
            std::vector<Vec2> corners;
            for (Vec c : source.corners) corners.push_back(toReal(c));
            shape.geometry = makePolygon(corners, static_cast<real>(source.radius));
        }
        shape.material.friction = static_cast<real>(scene.friction);
        shape.material.restitution = static_cast<real>(scene.restitution);
        body.createShape(shape);
        bodies_.push_back(body);
    }

    double dt_;
    int substeps_;
    World world_;
    std::vector<Body> bodies_;
};

}  // namespace

#if defined(TAMIAS_F64)
std::unique_ptr<Engine> makeTamiasF64(const Scene& scene)
#else
std::unique_ptr<Engine> makeTamiasF32(const Scene& scene)
#endif
{
    return std::make_unique<TamiasEngine>(scene);
}

}  // namespace tamias2d::verify
