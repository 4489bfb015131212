// SPDX-License-Identifier: MIT
#include "engine.hpp"

#include "profile/profile_json.hpp"

#include <tamias2d/tamias2d.hpp>

#include <algorithm>

// Tamias2D with its defaults: 60 steps a second of 4 sub-steps. Compiled once a precision.
namespace tamias2d::bench {
namespace {

Vec2 toReal(Vec v)
{
    return {static_cast<real>(v.x), static_cast<real>(v.y)};
}

ShapeDef shapeOf(const SceneShape& source)
{
    ShapeDef def;
    const real radius = static_cast<real>(source.radius);
    const std::vector<Vec>& c = source.corners;
    if (c.size() == 1) {
        def.geometry = Circle{toReal(c[0]), radius};
    } else if (c.size() == 2 && radius > 0) {
        def.geometry = Capsule{toReal(c[0]), toReal(c[1]), radius};
    } else if (c.size() == 2) {
        def.geometry = Segment{toReal(c[0]), toReal(c[1]), 0};
    } else {
        std::vector<Vec2> corners;
        for (Vec p : c) corners.push_back(toReal(p));
        def.geometry = makePolygon(corners, radius);
    }
    def.density = static_cast<real>(source.density);
    def.material.friction = static_cast<real>(source.friction);
    def.material.restitution = static_cast<real>(source.restitution);
    def.filter = {source.filter.category, source.filter.mask, source.filter.group};
    return def;
}

RevoluteJoint hingeOf(const SceneJoint& source)
{
    RevoluteJoint hinge{toReal(source.anchorA), toReal(source.anchorB), source.reference};
    if (const auto& l = source.limits)
        hinge.limits = {static_cast<real>(l->lower), static_cast<real>(l->upper)};
    if (const auto& m = source.motor)
        hinge.motor = {static_cast<real>(m->speed),
                       static_cast<real>(std::min<double>(m->maxTorque, kUnlimited))};
    if (const auto& s = source.spring)
        hinge.spring = {static_cast<real>(s->frequency), static_cast<real>(s->dampingRatio), 0};
    return hinge;
}

class TamiasEngine final : public Engine {
public:
    TamiasEngine(const Scene& scene, int threads)
        : Engine(scene),
          world_(WorldDef{.gravity = toReal(scene.gravity), .allowSleep = scene.sleep, .threads = threads})
    {
        bodies_.resize(scene.bodies.size());
        addAll();
    }

    ~TamiasEngine() override
    {
        if (profile_) profile_->finish();
    }

    void step() override
    {
        report_ = world_.step(kTimeStep);
        if (profile_) profile_->add(world_.profile(), static_cast<std::int64_t>(world_.stepCount()));
    }

    bool profileTo(std::ostream& out) override
    {
        profile_.emplace(out);
        world_.setProfiling(true);
        return true;
    }

    State state(std::size_t i) const override
    {
        const Body& body = bodies_[i];
        const Position p = body.position();
        const Vec2 v = body.linearVelocity();
        return {{p.x, p.y}, body.angle(), {v.x, v.y}, body.angularVelocity()};
    }

    void setVelocity(std::size_t i, Vec velocity, double spin) override
    {
        bodies_[i].setLinearVelocity(toReal(velocity));
        bodies_[i].setAngularVelocity(static_cast<real>(spin));
    }

    Counts counts() const override
    {
        return {static_cast<long>(report_.awake), static_cast<long>(report_.touching), world_.stateHash()};
    }

    std::map<std::string, double> phases() const override
    {
        const StageTimes& t = report_.times;
        return {{"pairs", t.pairs},     {"manifolds", t.manifolds}, {"graph", t.graph},
                {"impacts", t.impacts}, {"solve", t.solve},         {"finalize", t.finalize}};
    }

    std::map<std::string, std::size_t> memory() const override
    {
        std::map<std::string, std::size_t> bytes;
        for (const TableMemory& table : world_.memory().tables) bytes.emplace(table.name, table.bytes);
        return bytes;
    }

private:
    void make(std::size_t i) override
    {
        const SceneBody& source = scene_.bodies[i];
        BodyDef def;
        def.type = source.mobility == Mobility::Free     ? BodyType::Dynamic
                   : source.mobility == Mobility::Driven ? BodyType::Kinematic
                                                         : BodyType::Static;
        def.position = {source.start.position.x, source.start.position.y};
        def.angle = source.start.angle;
        def.linearVelocity = toReal(source.start.velocity);
        def.angularVelocity = static_cast<real>(source.start.spin);
        def.linearDamping = static_cast<real>(source.damping);
        def.allowSleep = source.maySleep;
        def.awake = !source.asleep;
        Body body = world_.createBody(def);
        for (const SceneShape& shape : source.shapes) body.createShape(shapeOf(shape));
        bodies_[i] = body;
        for (const SceneJoint& joint : jointsOf(scene_, i))
            world_.createJoint({.bodyA = bodies_[joint.a].id(), .bodyB = body.id(), .kind = hingeOf(joint)});
    }

    void unmake(std::size_t i) override { bodies_[i].destroy(); }  // and its joints

    World world_;
    std::vector<Body> bodies_;
    StepReport report_;
    std::optional<apps::ProfileJson> profile_;
};

}  // namespace

std::string engineTitle()
{
    return sizeof(real) == 4 ? "Tamias2D, float" : "Tamias2D, double";
}

std::unique_ptr<Engine> makeEngine(const Scene& scene, const Options& options)
{
    return std::make_unique<TamiasEngine>(scene, options.threads);
}

}  // namespace tamias2d::bench
