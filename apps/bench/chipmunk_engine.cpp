// SPDX-License-Identifier: MIT
#include "engine.hpp"

#include <chipmunk/chipmunk.h>

#include <cmath>

// Chipmunk 7 with its defaults: 10 iterations. It reckons in double.
namespace tamias2d::bench {
namespace {

cpVect toCp(Vec v)
{
    return cpv(v.x, v.y);
}

class ChipmunkEngine final : public Engine {
public:
    explicit ChipmunkEngine(const Scene& scene) : space_(cpSpaceNew())
    {
        cpSpaceSetGravity(space_, toCp(scene.gravity));
        if (scene.sleep) cpSpaceSetSleepTimeThreshold(space_, 0.5);
        for (const SceneBody& body : scene.bodies) add(body);
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            if (scene.bodies[i].asleep && scene.sleep) cpBodySleep(bodies_[i]);
    }

    ~ChipmunkEngine() override
    {
        for (cpShape* shape : shapes_) {
            cpSpaceRemoveShape(space_, shape);
            cpShapeFree(shape);
        }
        for (cpBody* body : bodies_) {
            if (cpSpaceContainsBody(space_, body)) cpSpaceRemoveBody(space_, body);
            cpBodyFree(body);
        }
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
            awake += cpBodyGetType(body) == CP_BODY_TYPE_DYNAMIC && !cpBodyIsSleeping(body) ? 1 : 0;
        return {awake, -1, 0};
    }

private:
    void add(const SceneBody& source)
    {
        cpBody* body = source.mobility == Mobility::Free     ? cpBodyNew(0, 0)
                       : source.mobility == Mobility::Driven ? cpBodyNewKinematic()
                                                             : cpBodyNewStatic();
        cpSpaceAddBody(space_, body);
        bodies_.push_back(body);
        for (const SceneShape& shape : source.shapes) {
            cpShape* made = make(body, shape);
            if (source.mobility == Mobility::Free) cpShapeSetDensity(made, shape.density);
            // It multiplies the values of the two shapes; the scenes use equal values on both.
            cpShapeSetFriction(made, std::sqrt(shape.friction));
            cpShapeSetElasticity(made, std::sqrt(shape.restitution));
            cpSpaceAddShape(space_, made);
            shapes_.push_back(made);
        }
        cpBodySetPosition(body, toCp(source.start.position));
        cpBodySetAngle(body, source.start.angle);
        if (source.mobility == Mobility::Fixed) {
            cpSpaceReindexShapesForBody(space_, body);
            return;
        }
        cpBodySetVelocity(body, toCp(source.start.velocity));
        cpBodySetAngularVelocity(body, source.start.spin);
    }

    cpShape* make(cpBody* body, const SceneShape& shape)
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
    std::vector<cpShape*> shapes_;
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
