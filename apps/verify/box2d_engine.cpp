// SPDX-License-Identifier: MIT
#include "engine.hpp"

#include <box2d/box2d.h>

// Box2D 2.4 with the iterations its manual recommends; sleeping off.
namespace tamias2d::verify {
namespace {

constexpr int kVelocityIterations = 8;
constexpr int kPositionIterations = 3;

b2Vec2 toB2(Vec v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

class Box2DEngine final : public Engine {
public:
    explicit Box2DEngine(const Scene& scene) : scene_(scene), world_(toB2(scene.gravity))
    {
        world_.SetAllowSleeping(false);
        for (const SceneBody& body : scene.bodies) add(body);
    }

    void step() override
    {
        if (scene_.pull || scene_.gravitation != 0) pull();
        world_.Step(static_cast<float>(1 / scene_.rate), kVelocityIterations, kPositionIterations);
        time_ += 1 / scene_.rate;
    }

    State state(std::size_t i) const override
    {
        const b2Body& body = *bodies_[i];
        const b2Vec2 p = body.GetPosition(), v = body.GetLinearVelocity();
        return {{p.x, p.y}, body.GetAngle(), {v.x, v.y}, body.GetAngularVelocity()};
    }

private:
    void add(const SceneBody& source)
    {
        b2BodyDef def;
        def.type = source.fixed ? b2_staticBody : b2_dynamicBody;
        def.position = toB2(source.start.position);
        def.angle = static_cast<float>(source.start.angle);
        def.linearVelocity = toB2(source.start.velocity);
        def.angularVelocity = static_cast<float>(source.start.spin);
        def.linearDamping = def.angularDamping = static_cast<float>(scene_.damping);
        def.bullet = source.fast;
        b2Body* body = world_.CreateBody(&def);
        bodies_.push_back(body);

        b2CircleShape circle;
        circle.m_radius = static_cast<float>(source.radius);
        b2PolygonShape polygon;
        b2FixtureDef fixture;
        fixture.shape = &circle;
        if (source.outline == Outline::Polygon) {
            std::vector<b2Vec2> corners;
            for (Vec c : source.corners) corners.push_back(toB2(c));
            polygon.Set(corners.data(), static_cast<int32>(corners.size()));
            fixture.shape = &polygon;
        }
        fixture.density = 1;
        fixture.friction = static_cast<float>(scene_.friction);
        fixture.restitution = static_cast<float>(scene_.restitution);
        body->CreateFixture(&fixture);
        if (source.fixed) return;
        b2MassData mass;
        mass.mass = static_cast<float>(source.mass);
        mass.center.SetZero();
        mass.I = static_cast<float>(source.inertia);
        body->SetMassData(&mass);
    }

    void pull()
    {
        std::vector<State> states(bodies_.size());
        for (std::size_t i = 0; i < states.size(); ++i) states[i] = state(i);
        const std::vector<Pull> pulls = pullsOn(scene_, states, time_);
        for (std::size_t i = 0; i < pulls.size(); ++i) {
            bodies_[i]->ApplyForceToCenter(toB2(pulls[i].force), true);
            bodies_[i]->ApplyTorque(static_cast<float>(pulls[i].torque), true);
        }
    }

    const Scene& scene_;
    b2World world_;
    std::vector<b2Body*> bodies_;
    double time_ = 0;
};

}  // namespace

std::unique_ptr<Engine> makeBox2D(const Scene& scene)
{
    return std::make_unique<Box2DEngine>(scene);
}

}  // namespace tamias2d::verify
