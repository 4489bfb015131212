// SPDX-License-Identifier: MIT
#include "box2d_hinge.hpp"
#include "engine.hpp"

#include <box2d/box2d.h>

// Box2D 2.4 with the iterations its manual recommends.
namespace tamias2d::bench {
namespace {

constexpr int kVelocityIterations = 8;
constexpr int kPositionIterations = 3;

b2Vec2 toB2(Vec v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

class Box2DEngine final : public Engine {
public:
    explicit Box2DEngine(const Scene& scene)
        : Engine(scene), world_(toB2(scene.gravity)), bodies_(scene.bodies.size())
    {
        world_.SetAllowSleeping(scene.sleep);
        addAll();
    }

    void step() override
    {
        world_.Step(static_cast<float>(kTimeStep), kVelocityIterations, kPositionIterations);
    }

    State state(std::size_t i) const override
    {
        const b2Body& body = *bodies_[i];
        const b2Vec2 p = body.GetPosition(), v = body.GetLinearVelocity();
        return {{p.x, p.y}, body.GetAngle(), {v.x, v.y}, body.GetAngularVelocity()};
    }

    void setVelocity(std::size_t i, Vec velocity, double spin) override
    {
        bodies_[i]->SetLinearVelocity(toB2(velocity));
        bodies_[i]->SetAngularVelocity(static_cast<float>(spin));
    }

    Counts counts() const override
    {
        Counts counts{0, 0, 0};
        for (const b2Body* body : bodies_)
            counts.awake += body != nullptr && body->GetType() == b2_dynamicBody && body->IsAwake() ? 1 : 0;
        for (const b2Contact* c = world_.GetContactList(); c != nullptr; c = c->GetNext())
            counts.contacts += c->IsTouching() ? 1 : 0;
        return counts;
    }

private:
    void make(std::size_t i) override
    {
        const SceneBody& source = scene_.bodies[i];
        b2BodyDef def;
        def.type = source.mobility == Mobility::Free     ? b2_dynamicBody
                   : source.mobility == Mobility::Driven ? b2_kinematicBody
                                                         : b2_staticBody;
        def.position = toB2(source.start.position);
        def.angle = static_cast<float>(source.start.angle);
        def.linearVelocity = toB2(source.start.velocity);
        def.angularVelocity = static_cast<float>(source.start.spin);
        def.linearDamping = static_cast<float>(source.damping);
        def.allowSleep = source.maySleep;
        def.awake = !source.asleep;
        b2Body* body = world_.CreateBody(&def);
        bodies_[i] = body;
        for (const SceneShape& shape : source.shapes) attach(*body, shape);
        for (const SceneJoint& joint : jointsOf(scene_, i)) join(joint);
    }

    void unmake(std::size_t i) override
    {
        world_.DestroyBody(bodies_[i]);  // and its joints
        bodies_[i] = nullptr;
    }

    // It has no hinges with springs: these are left out.
    void join(const SceneJoint& joint)
    {
        b2RevoluteJointDef def;
        def.bodyA = bodies_[joint.a];
        def.bodyB = bodies_[joint.b];
        def.localAnchorA = toB2(joint.anchorA);
        def.localAnchorB = toB2(joint.anchorB);
        def.referenceAngle = static_cast<float>(joint.reference);
        setLimitsAndMotor(joint, def);
        world_.CreateJoint(&def);
    }

    // It has no capsules: a box with two discs stands for one.
    void attach(b2Body& body, const SceneShape& shape)
    {
        const std::vector<Vec>& c = shape.corners;
        const bool isLine = c.size() == 2 && !(shape.radius > 0);
        std::vector<b2Vec2> corners;
        for (Vec p : c) corners.push_back(toB2(p));
        b2FixtureDef fixture;
        fixture.density = static_cast<float>(shape.density);
        fixture.friction = static_cast<float>(shape.friction);
        fixture.restitution = static_cast<float>(shape.restitution);
        fixture.filter.categoryBits = static_cast<uint16>(shape.filter.category);
        fixture.filter.maskBits = static_cast<uint16>(shape.filter.mask);
        fixture.filter.groupIndex = static_cast<int16>(shape.filter.group);
        if (c.size() <= 2 && !isLine) {
            for (b2Vec2 center : corners) {
                b2CircleShape circle;
                circle.m_p = center;
                circle.m_radius = static_cast<float>(shape.radius);
                fixture.shape = &circle;
                body.CreateFixture(&fixture);
            }
            if (c.size() == 1) return;
            const float r = static_cast<float>(shape.radius);
            const b2Vec2 along = corners[1] - corners[0],
                         side = r / along.Length() * b2Vec2(-along.y, along.x);
            corners = {corners[0] - side, corners[1] - side, corners[1] + side, corners[0] + side};
        }
        b2EdgeShape edge;
        b2PolygonShape polygon;
        if (isLine)
            edge.SetTwoSided(corners[0], corners[1]);
        else
            polygon.Set(corners.data(), static_cast<int32>(corners.size()));
        fixture.shape = isLine ? static_cast<const b2Shape*>(&edge) : &polygon;
        body.CreateFixture(&fixture);
    }

    b2World world_;
    std::vector<b2Body*> bodies_;
};

}  // namespace

std::string engineTitle()
{
    return "Box2D 2.4.1, 8 and 3 iterations";
}

std::unique_ptr<Engine> makeEngine(const Scene& scene, const Options&)
{
    return std::make_unique<Box2DEngine>(scene);
}

}  // namespace tamias2d::bench
