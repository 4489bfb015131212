// SPDX-License-Identifier: MIT
#include "engine.hpp"

#include <chipmunk/chipmunk.h>

#include <cmath>

// Chipmunk 7 with its defaults: 10 iterations, collision slop 0.1 m, sleeping off.
namespace tamias2d::verify {
namespace {

class ChipmunkEngine final : public Engine {
public:
    explicit ChipmunkEngine(const Scene& scene) : scene_(scene), space_(cpSpaceNew())
    {
        cpSpaceSetGravity(space_, cpv(scene.gravity.x, scene.gravity.y));
        cpSpaceSetDamping(space_, std::exp(-scene.damping));
        for (const SceneBody& body : scene.bodies) add(body);
    }

    ~ChipmunkEngine() override
    {
        for (cpShape* shape : shapes_) {
            cpSpaceRemoveShape(space_, shape);
            cpShapeFree(shape);
        }
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (!scene_.bodies[i].fixed) cpSpaceRemoveBody(space_, bodies_[i]);
            cpBodyFree(bodies_[i]);
        }
        cpSpaceFree(space_);
    }

    void step() override
    {
        if (scene_.pull || scene_.gravitation != 0) pull();
        cpSpaceStep(space_, 1 / scene_.rate);
        time_ += 1 / scene_.rate;
    }

    State state(std::size_t i) const override
    {
        const cpVect p = cpBodyGetPosition(bodies_[i]), v = cpBodyGetVelocity(bodies_[i]);
        return {{p.x, p.y}, cpBodyGetAngle(bodies_[i]), {v.x, v.y}, cpBodyGetAngularVelocity(bodies_[i])};
    }

private:
    void add(const SceneBody& source)
    {
        cpBody* body = source.fixed ? cpBodyNewStatic() : cpBodyNew(source.mass, source.inertia);
        const State& s = source.start;
        cpBodySetPosition(body, cpv(s.position.x, s.position.y));
        cpBodySetAngle(body, s.angle);
        if (!source.fixed) {
            cpBodySetVelocity(body, cpv(s.velocity.x, s.velocity.y));
            cpBodySetAngularVelocity(body, s.spin);
            cpSpaceAddBody(space_, body);
        }
        bodies_.push_back(body);

        cpShape* shape = nullptr;
        if (source.outline == Outline::Disc) {
            shape = cpCircleShapeNew(body, source.radius, cpvzero);
        } else {
            std::vector<cpVect> corners;
            for (Vec c : source.corners) corners.push_back(cpv(c.x, c.y));
            shape = cpPolyShapeNewRaw(body, static_cast<int>(corners.size()), corners.data(), source.radius);
        }
        // It multiplies the values of the two shapes; the scene states the value of the pair.
        cpShapeSetFriction(shape, std::sqrt(scene_.friction));
        cpShapeSetElasticity(shape, std::sqrt(scene_.restitution));
        cpSpaceAddShape(space_, shape);
        shapes_.push_back(shape);
    }

    void pull()
    {
        std::vector<State> states(bodies_.size());
        for (std::size_t i = 0; i < states.size(); ++i) states[i] = state(i);
        const std::vector<Pull> pulls = pullsOn(scene_, states, time_);
        for (std::size_t i = 0; i < pulls.size(); ++i) {
            if (scene_.bodies[i].fixed) continue;
            cpBodySetForce(bodies_[i], cpv(pulls[i].force.x, pulls[i].force.y));
            cpBodySetTorque(bodies_[i], pulls[i].torque);
        }
    }

    const Scene& scene_;
    cpSpace* space_;
    std::vector<cpBody*> bodies_;
    std::vector<cpShape*> shapes_;
    double time_ = 0;
};

}  // namespace

std::unique_ptr<Engine> makeChipmunk(const Scene& scene)
{
    return std::make_unique<ChipmunkEngine>(scene);
}

}  // namespace tamias2d::verify
