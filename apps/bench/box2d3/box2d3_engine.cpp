// SPDX-License-Identifier: MIT
#include "box2d_hinge.hpp"
#include "engine.hpp"

#include <box2d/box2d.h>

#include <cmath>

// Box2D 3 with its defaults: 4 sub-steps.
namespace tamias2d::bench {
namespace {

b2Vec2 toB2(Vec v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

class Box2DEngine final : public Engine {
public:
    Box2DEngine(const Scene& scene, int threads) : Engine(scene), bodies_(scene.bodies.size())
    {
        b2WorldDef def = b2DefaultWorldDef();
        def.gravity = toB2(scene.gravity);
        def.enableSleep = scene.sleep;
        def.workerCount = threads;
        world_ = b2CreateWorld(&def);
        addAll();
    }
    ~Box2DEngine() override { b2DestroyWorld(world_); }

    void step() override { b2World_Step(world_, static_cast<float>(kTimeStep), 4); }

    State state(std::size_t i) const override
    {
        const b2BodyId id = bodies_[i];
        const auto p = b2Body_GetPosition(id);
        const b2Vec2 v = b2Body_GetLinearVelocity(id);
        return {
            {p.x, p.y}, b2Rot_GetAngle(b2Body_GetRotation(id)), {v.x, v.y}, b2Body_GetAngularVelocity(id)};
    }

    void setVelocity(std::size_t i, Vec velocity, double spin) override
    {
        b2Body_SetLinearVelocity(bodies_[i], toB2(velocity));
        b2Body_SetAngularVelocity(bodies_[i], static_cast<float>(spin));
    }

    Counts counts() const override
    {
        // Contacts that touch are in the colors of awake islands; it counts no others apart.
        return {b2World_GetAwakeBodyCount(world_), b2World_GetCounters(world_).contactCount, 0};
    }

    std::map<std::string, double> phases() const override
    {
        const b2Profile p = b2World_GetProfile(world_);
        return {{"pairs", p.pairs}, {"collide", p.collide}, {"solve", p.solve}};
    }

private:
    void make(std::size_t i) override
    {
        const SceneBody& source = scene_.bodies[i];
        b2BodyDef def = b2DefaultBodyDef();
        def.type = source.mobility == Mobility::Free     ? b2_dynamicBody
                   : source.mobility == Mobility::Driven ? b2_kinematicBody
                                                         : b2_staticBody;
        def.position = {static_cast<float>(source.start.position.x),
                        static_cast<float>(source.start.position.y)};
        def.rotation = b2MakeRot(static_cast<float>(source.start.angle));
        def.linearVelocity = toB2(source.start.velocity);
        def.angularVelocity = static_cast<float>(source.start.spin);
        def.linearDamping = static_cast<float>(source.damping);
        def.enableSleep = source.maySleep;
        def.isAwake = !source.asleep;
        const b2BodyId body = b2CreateBody(world_, &def);
        bodies_[i] = body;
        for (const SceneShape& shape : source.shapes) attach(body, shape);
        for (const SceneJoint& joint : jointsOf(scene_, i)) join(joint);
    }

    void unmake(std::size_t i) override { b2DestroyBody(bodies_[i]); }  // and its joints

    void join(const SceneJoint& joint)
    {
        b2RevoluteJointDef def = b2DefaultRevoluteJointDef();
        def.base.bodyIdA = bodies_[joint.a];
        def.base.bodyIdB = bodies_[joint.b];
        def.base.localFrameA = {toB2(joint.anchorA), b2MakeRot(static_cast<float>(joint.reference))};
        def.base.localFrameB.p = toB2(joint.anchorB);
        setLimitsAndMotor(joint, def);
        if (const auto& s = joint.spring) {
            def.enableSpring = true;
            def.hertz = static_cast<float>(s->frequency);
            def.dampingRatio = static_cast<float>(s->dampingRatio);
        }
        b2CreateRevoluteJoint(world_, &def);
    }

    static void attach(b2BodyId body, const SceneShape& shape)
    {
        b2ShapeDef def = b2DefaultShapeDef();
        def.density = static_cast<float>(shape.density);
        def.material.friction = static_cast<float>(shape.friction);
        def.material.restitution = static_cast<float>(shape.restitution);
        def.filter.categoryBits = shape.filter.category;
        def.filter.maskBits = shape.filter.mask;
        def.filter.groupIndex = shape.filter.group;
        std::vector<b2Vec2> corners;
        for (Vec p : shape.corners) corners.push_back(toB2(p));
        const float radius = static_cast<float>(shape.radius);
        if (corners.size() == 1) {
            const b2Circle circle{corners[0], radius};
            b2CreateCircleShape(body, &def, &circle);
        } else if (corners.size() == 2 && radius > 0) {
            const b2Capsule capsule{corners[0], corners[1], radius};
            b2CreateCapsuleShape(body, &def, &capsule);
        } else if (corners.size() == 2) {
            const b2Segment segment{corners[0], corners[1]};
            b2CreateSegmentShape(body, &def, &segment);
        } else {
            const b2Hull hull = b2ComputeHull(corners.data(), static_cast<int>(corners.size()));
            const b2Polygon polygon = b2MakePolygon(&hull, radius);
            b2CreatePolygonShape(body, &def, &polygon);
        }
    }

    b2WorldId world_;
    std::vector<b2BodyId> bodies_;
};

}  // namespace

std::string engineTitle()
{
    const b2Version v = b2GetVersion();
    return "Box2D " + std::to_string(v.major) + "." + std::to_string(v.minor) + "." +
           std::to_string(v.revision) + ", 4 sub-steps";
}

std::unique_ptr<Engine> makeEngine(const Scene& scene, const Options& options)
{
    return std::make_unique<Box2DEngine>(scene, options.threads);
}

}  // namespace tamias2d::bench
