// SPDX-License-Identifier: MIT
#include "engine.hpp"

#include <chipmunk/chipmunk.h>

#include <cmath>
#include <numbers>

// Chipmunk 7 with its defaults: 10 iterations. It reckons in double.
namespace tamias2d::bench {
namespace {

cpVect toCp(Vec v)
{
    return cpv(v.x, v.y);
}

// Each body has its own damping.
void dampedVelocity(cpBody* body, cpVect gravity, cpFloat damping, cpFloat dt)
{
    const auto& source = *static_cast<const SceneBody*>(cpBodyGetUserData(body));
    cpBodyUpdateVelocity(body, gravity, damping * std::exp(-source.damping * dt), dt);
}

class ChipmunkEngine final : public Engine {
public:
    explicit ChipmunkEngine(const Scene& scene)
        : Engine(scene), space_(cpSpaceNew()), bodies_(scene.bodies.size()), joints_(scene.bodies.size())
    {
        cpSpaceSetGravity(space_, toCp(scene.gravity));
        if (scene.sleep) cpSpaceSetSleepTimeThreshold(space_, 0.5);
        addAll();
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            if (scene.bodies[i].asleep && scene.sleep) cpBodySleep(bodies_[i]);
    }

    ~ChipmunkEngine() override
    {
        for (std::size_t i = bodies_.size(); i-- > 0;)
            if (has(i)) unmake(i);
        cpSpaceFree(space_);
    }

    void step() override { cpSpaceStep(space_, kTimeStep); }

    State state(std::size_t i) const override
    {
        const cpVect p = cpBodyGetPosition(bodies_[i]), v = cpBodyGetVelocity(bodies_[i]);
        return {{p.x, p.y}, cpBodyGetAngle(bodies_[i]), {v.x, v.y}, cpBodyGetAngularVelocity(bodies_[i])};
    }

    void setVelocity(std::size_t i, Vec velocity, double spin) override
    {
        cpBodySetVelocity(bodies_[i], toCp(velocity));
        cpBodySetAngularVelocity(bodies_[i], spin);
    }

    Counts counts() const override
    {
        long awake = 0;
        for (cpBody* body : bodies_)
            awake += body != nullptr && cpBodyGetType(body) == CP_BODY_TYPE_DYNAMIC && !cpBodyIsSleeping(body)
                         ? 1
                         : 0;
        return {awake, -1, 0};
    }

private:
    void make(std::size_t i) override
    {
        const SceneBody& source = scene_.bodies[i];
        cpBody* body = source.mobility == Mobility::Free     ? cpBodyNew(0, 0)
                       : source.mobility == Mobility::Driven ? cpBodyNewKinematic()
                                                             : cpBodyNewStatic();
        cpSpaceAddBody(space_, body);
        bodies_[i] = body;
        if (source.damping > 0) {
            cpBodySetUserData(body, const_cast<SceneBody*>(&source));
            cpBodySetVelocityUpdateFunc(body, dampedVelocity);
        }
        for (const SceneShape& shape : source.shapes) {
            cpShape* made = shapeOf(body, shape);
            if (source.mobility == Mobility::Free) cpShapeSetDensity(made, shape.density);
            // It multiplies the values of the two shapes; the scenes use equal values on both.
            cpShapeSetFriction(made, std::sqrt(shape.friction));
            cpShapeSetElasticity(made, std::sqrt(shape.restitution));
            cpShapeSetFilter(made, filterOf(shape.filter));
            cpSpaceAddShape(space_, made);
        }
        cpBodySetPosition(body, toCp(source.start.position));
        cpBodySetAngle(body, source.start.angle);
        if (source.mobility == Mobility::Fixed) {
            cpSpaceReindexShapesForBody(space_, body);
            return;
        }
        cpBodySetVelocity(body, toCp(source.start.velocity));
        cpBodySetAngularVelocity(body, source.start.spin);
        for (const SceneJoint& joint : jointsOf(scene_, i)) join(joint, joints_[i]);
    }

    void unmake(std::size_t i) override
    {
        for (cpConstraint* joint : joints_[i]) {
            cpSpaceRemoveConstraint(space_, joint);
            cpConstraintFree(joint);
        }
        joints_[i].clear();
        cpBody* body = bodies_[i];
        std::vector<cpShape*> shapes;
        const auto collect = [](cpBody*, cpShape* shape, void* list) {
            static_cast<std::vector<cpShape*>*>(list)->push_back(shape);
        };
        cpBodyEachShape(body, collect, &shapes);
        for (cpShape* shape : shapes) {
            cpSpaceRemoveShape(space_, shape);
            cpShapeFree(shape);
        }
        cpSpaceRemoveBody(space_, body);
        cpBodyFree(body);
        bodies_[i] = nullptr;
    }

    // Its groups are those that do not collide.
    static cpShapeFilter filterOf(const SceneFilter& filter)
    {
        return cpShapeFilterNew(filter.group < 0 ? static_cast<cpGroup>(-filter.group) : CP_NO_GROUP,
                                filter.category, filter.mask);
    }

    // A hinge is a pivot, and a constraint more for each thing it has.
    void join(const SceneJoint& joint, std::vector<cpConstraint*>& made)
    {
        cpBody *a = bodies_[joint.a], *b = bodies_[joint.b];
        const auto add = [&](cpConstraint* constraint) {
            cpConstraintSetCollideBodies(constraint, cpFalse);
            made.push_back(cpSpaceAddConstraint(space_, constraint));
        };
        add(cpPivotJointNew2(a, b, toCp(joint.anchorA), toCp(joint.anchorB)));
        if (const auto& l = joint.limits)
            add(cpRotaryLimitJointNew(a, b, joint.reference + l->lower, joint.reference + l->upper));
        if (const auto& m = joint.motor) {
            cpConstraint* motor = cpSimpleMotorNew(a, b, -m->speed);
            cpConstraintSetMaxForce(motor, m->maxTorque);
            add(motor);
        }
        if (const auto& s = joint.spring) {
            const double inertia = 1 / (1 / cpBodyGetMoment(a) + 1 / cpBodyGetMoment(b));
            const double rate = 2 * std::numbers::pi * s->frequency;
            // Its angle is that of A against B.
            add(cpDampedRotarySpringNew(a, b, -joint.reference, inertia * rate * rate,
                                        2 * s->dampingRatio * inertia * rate));
        }
    }

    static cpShape* shapeOf(cpBody* body, const SceneShape& shape)
    {
        const std::vector<Vec>& c = shape.corners;
        if (c.size() == 1) return cpCircleShapeNew(body, shape.radius, toCp(c[0]));
        if (c.size() == 2) return cpSegmentShapeNew(body, toCp(c[0]), toCp(c[1]), shape.radius);
        std::vector<cpVect> corners;
        for (Vec p : c) corners.push_back(toCp(p));
        return cpPolyShapeNewRaw(body, static_cast<int>(corners.size()), corners.data(), shape.radius);
    }

    cpSpace* space_;
    std::vector<cpBody*> bodies_;
    std::vector<std::vector<cpConstraint*>> joints_;  // by the later body
};

}  // namespace

std::string engineTitle()
{
    return std::string("Chipmunk ") + cpVersionString + ", 10 iterations";
}

std::unique_ptr<Engine> makeEngine(const Scene& scene, const Options&)
{
    return std::make_unique<ChipmunkEngine>(scene);
}

}  // namespace tamias2d::bench
