// SPDX-License-Identifier: MIT
#pragma once

#include "support/build.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace tamias2d::test {

/// A random script: within four walls anything is created, destroyed, moved, changed and stepped, in any
/// order. Each thing that can be done is a line of operations(): what comes to the library gets a line there,
/// and is then part of every test by scripts.
class RandomScript {
public:
    explicit RandomScript(std::uint32_t seed, const WorldDef& def = {}) : world_(def), random_(seed)
    {
        addWalls(world_, {-8, 0}, {8, 10}, {.restitution = 0.3});
        for (const Operation& operation : operations()) weights_ += operation.weight;
    }
    virtual ~RandomScript() = default;
    RandomScript(RandomScript&&) = delete;

    /// Runs on until something fails.
    void run(int count)
    {
        for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
            const Operation& operation = choose();
            SCOPED_TRACE("operation " + std::to_string(i) + ": " + operation.name);
            (this->*operation.act)();
            afterEach();
        }
    }

    World& world() { return world_; }
    int steps() const { return steps_; }

protected:
    virtual void afterStep(const StepReport&) {}
    virtual void afterEach() {}

    double between(double a, double b) { return random_.between(a, b); }
    int below(int n) { return std::min(static_cast<int>(between(0, n)), n - 1); }

    World world_;

private:
    struct Operation {
        const char* name;
        int weight;  // how often, against the others
        void (RandomScript::*act)();
    };

    static const std::vector<Operation>& operations()
    {
        using S = RandomScript;
        static const std::vector<Operation> all = {
            {"step", 24, &S::step},
            {"create a body", 6, &S::createBody},
            {"destroy a body", 3, &S::destroyBody},
            {"create a shape", 2, &S::createShape},
            {"destroy a shape", 2, &S::destroyShape},
            {"redefine a shape", 2, &S::redefineShape},
            {"set material", 1, &S::setMaterial},
            {"set filter", 2, &S::setFilter},
            {"set density", 1, &S::setDensity},
            {"move a body", 2, &S::moveBody},
            {"move many bodies", 1, &S::moveMany},
            {"set velocity", 2, &S::setVelocity},
            {"set type", 2, &S::setType},
            {"set mass", 2, &S::setMass},
            {"enable or disable", 2, &S::setEnabled},
            {"set locks", 2, &S::setLocks},
            {"set damping", 1, &S::setDamping},
            {"wake", 1, &S::wake},
            {"put to sleep", 3, &S::putToSleep},
            {"allow sleep", 1, &S::allowSleep},
            {"push", 2, &S::push},
            {"push on", 2, &S::pushOn},
            {"set gravity", 2, &S::setGravity},
            {"add or remove a force law", 1, &S::changeLaws},
            {"create a joint", 5, &S::createJoint},
            {"destroy a joint", 2, &S::destroyJoint},
            {"give a joint another kind", 2, &S::setKind},
            {"change a joint", 2, &S::changeJoint},
        };
        return all;
    }

    const Operation& choose()
    {
        int left = below(weights_);
        for (const Operation& operation : operations())
            if ((left -= operation.weight) < 0) return operation;
        return operations().front();
    }

    // --- what is chosen by chance

    Position anyPlace() { return {between(-7, 7), between(0.5, 9.5)}; }
    Vec2 anyVelocity()
    {
        const double x = between(-8, 8);
        return vec(x, between(-8, 8));
    }

    // Any body but the walls, which stay, so that the others do; a null one if there is none.
    Body anyBody()
    {
        const std::vector<BodyId> ids = world_.bodies();
        if (ids.size() <= 4) return {};
        return world_.body(ids[static_cast<std::size_t>(4 + below(static_cast<int>(ids.size()) - 4))]);
    }
    Shape anyShape()
    {
        const Body body = anyBody();
        if (!body.isAlive()) return {};
        const std::vector<Shape> shapes = body.shapes();
        if (shapes.empty()) return {};
        return shapes[static_cast<std::size_t>(below(static_cast<int>(shapes.size())))];
    }

    Filter anyFilter()
    {
        Filter filter;
        filter.category = 1u << below(3);
        filter.mask = static_cast<std::uint64_t>(below(8));
        filter.group = below(5) - 2;
        return filter;
    }

    Material anyMaterial()
    {
        Material material;
        material.restitution = toReal(below(3) == 0 ? 0 : between(0, 1));
        material.friction = toReal(between(0, 1));
        material.rollingResistance = toReal(below(4) == 0 ? 0.1 : 0);
        material.surfaceSpeed = toReal(below(8) == 0 ? between(-2, 2) : 0);
        return material;
    }

    Geometry anyGeometry()
    {
        const double a = between(0.2, 1), b = between(0.2, 1);
        switch (below(5)) {
        case 0:
            return Circle{{}, toReal(a * 0.6)};
        case 1:
            return makeBox(toReal(a), toReal(b), toReal(below(2) == 0 ? 0 : 0.05));
        case 2:
            return Capsule{vec(-0.3, 0), vec(0.3, 0.1), toReal(b * 0.3)};
        case 3:
            return makeRegularPolygon(3 + below(14), toReal(0.1 + b / 2), toReal(0.05));
        default:
            return Segment{vec(-0.6, 0), vec(0.6, 0), toReal(below(2) == 0 ? 0 : 0.05)};
        }
    }

    ShapeDef anyShapeDef()
    {
        ShapeDef def;
        def.geometry = anyGeometry();
        const double x = between(-0.3, 0.3);
        def.offset = vec(x, between(-0.3, 0.3));
        def.angle = between(0, 6);
        def.density = toReal(between(0, 3));
        def.material = anyMaterial();
        if (below(6) == 0) def.filter = anyFilter();
        return def;
    }

    bool isPushed(BodyId body) { return world_.body(body).type() == BodyType::Dynamic; }

    Joint anyJoint()
    {
        const std::vector<JointId> ids = world_.joints();
        if (ids.empty()) return {};
        return world_.joint(ids[static_cast<std::size_t>(below(static_cast<int>(ids.size())))]);
    }

    Vec2 anyAnchor()
    {
        const double x = between(-0.5, 0.5);
        return vec(x, between(-0.5, 0.5));
    }
    Vec2 anyAxis()
    {
        const double angle = between(0, 6);
        return vec(std::cos(angle), std::sin(angle));
    }
    std::optional<JointLimits> anyLimits()
    {
        const double lower = between(-2, 0), upper = between(0, 2);
        if (below(2) == 0) return std::nullopt;
        return JointLimits{toReal(lower), below(4) == 0 ? kUnlimited : toReal(upper)};
    }
    std::optional<JointMotor> anyMotor()
    {
        const double speed = between(-5, 5), force = between(0, 50);
        if (below(2) == 0) return std::nullopt;
        return JointMotor{toReal(speed), below(4) == 0 ? kUnlimited : toReal(force)};
    }
    std::optional<JointSpring> anySpring(double rest)
    {
        const double frequency = between(0, 20), ratio = between(0, 2);
        if (below(2) == 0) return std::nullopt;
        return JointSpring{toReal(frequency), toReal(ratio), toReal(rest)};
    }

    JointKind anyKind()
    {
        const Vec2 a = anyAnchor(), b = anyAnchor(), axis = anyAxis();
        const double angle = between(-3, 3), way = between(-1, 1),
                     force = below(8) == 0 ? 1e30 : between(0, 100);
        const std::optional<JointLimits> limits = anyLimits();
        const std::optional<JointMotor> motor = anyMotor();
        const std::optional<JointSpring> spring = anySpring(way), still = anySpring(0);
        switch (below(15)) {
        case 0:
            return RevoluteJoint{a, b, angle, limits, motor, spring};
        case 1: {
            std::optional<JointLimits> lengths = limits;
            if (lengths) lengths = JointLimits{0, lengths->upper + 1};
            return DistanceJoint{a, b, toReal(0.5 + std::abs(way)), lengths, motor, anySpring(std::abs(way))};
        }
        case 2:
            return PrismaticJoint{a, b, axis, angle, limits, motor, spring};
        case 3:
            return WeldJoint{a, b, angle, still, anySpring(0)};
        case 4:
            return TargetJoint{b,
                               anyPlace(),
                               below(2) == 0 ? std::optional<double>(angle) : std::nullopt,
                               toReal(between(0.1, 30)),
                               toReal(between(0, 2)),
                               toReal(force),
                               toReal(force)};
        case 5:
            return WheelJoint{a, b, axis, limits, motor, spring};
        case 6:
            return GrooveJoint{a, a + toReal(0.5 + std::abs(way)) * axis, b};
        case 7:
            return RotaryJoint{angle, limits, motor, spring};
        case 8:
            return RatchetJoint{angle, toReal(way < 0 ? way - 0.01 : way + 0.01)};
        case 9:
            return GearJoint{toReal(angle < 0 ? angle - 0.01 : angle + 0.01), angle};
        case 10:
            return RackJoint{a, b, axis, toReal(way < 0 ? way - 0.01 : way + 0.01), angle};
        case 11: {
            const Position one = anyPlace(), other = anyPlace();
            return PulleyJoint{
                a, b, one, other, toReal(between(0.2, 5)), toReal(between(2, 15)), below(2) == 0};
        }
        case 12:
            return MotorJoint{
                a, b, angle, still, anySpring(0), 5 * axis, toReal(angle), toReal(force), toReal(force)};
        case 13:
            return FrictionJoint{b, toReal(force), toReal(force)};
        default:
            return FilterJoint{};
        }
    }

    // --- the operations

    void step()
    {
        ++steps_;
        const StepReport report = world_.step(1.0 / 60, 1 + below(4));
        EXPECT_EQ(report.status, StepStatus::Done);
        EXPECT_EQ(report.nonFinite, 0u);
        afterStep(report);
    }

    void createBody()
    {
        constexpr std::size_t kMost = 50;
        if (world_.bodyCount() >= kMost) return;
        BodyDef def;
        def.type = below(8) == 0 ? BodyType::Kinematic : below(8) == 0 ? BodyType::Static : BodyType::Dynamic;
        def.position = anyPlace();
        def.angle = between(-9, 9);
        def.linearVelocity = def.type == BodyType::Static ? Vec2{} : anyVelocity();
        def.enabled = below(10) != 0;
        Body body = world_.createBody(def);
        for (int i = below(3); i >= 0; --i) body.createShape(anyShapeDef());
    }

    void destroyBody()
    {
        Body body = anyBody();
        if (body.isAlive()) body.destroy();
    }

    void createShape()
    {
        Body body = anyBody();
        if (body.isAlive()) body.createShape(anyShapeDef());
    }

    void destroyShape()
    {
        Shape shape = anyShape();
        if (shape.isAlive()) shape.destroy();
    }

    void redefineShape()
    {
        Shape shape = anyShape();
        if (shape.isAlive()) shape.redefine(anyShapeDef());
    }

    void setMaterial()
    {
        Shape shape = anyShape();
        if (shape.isAlive()) shape.setMaterial(anyMaterial());
    }

    void setFilter()
    {
        Shape shape = anyShape();
        if (shape.isAlive()) shape.setFilter(below(2) == 0 ? Filter{} : anyFilter());
    }

    void setDensity()
    {
        Shape shape = anyShape();
        if (shape.isAlive()) shape.setDensity(toReal(between(0.1, 3)));
    }

    void moveBody()
    {
        Body body = anyBody();
        if (!body.isAlive()) return;
        const Position place = anyPlace();
        body.setTransform(place, between(-9, 9));
    }

    void moveMany()
    {
        std::vector<BodyId> ids;
        std::vector<BodyState> states;
        for (const BodyId id : world_.bodies()) {
            if (id.index < 4 || below(4) != 0) continue;
            ids.push_back(id);
            const Position place = anyPlace();
            const double angle = between(-9, 9);
            states.push_back({place, angle, anyVelocity(), toReal(between(-5, 5))});
        }
        world_.writeStates(ids, states);
    }

    void setVelocity()
    {
        Body body = anyBody();
        if (!body.isAlive()) return;
        body.setLinearVelocity(anyVelocity());
        body.setAngularVelocity(toReal(between(-10, 10)));
    }

    void setType()
    {
        Body body = anyBody();
        if (body.isAlive()) body.setType(static_cast<BodyType>(below(3)));
    }

    void setMass()
    {
        Body body = anyBody();
        if (!body.isAlive()) return;
        if (below(2) == 0) {
            body.resetMass();
        } else {
            const double mass = between(0.1, 10), x = between(-0.2, 0.2);
            body.setMass({toReal(mass), vec(x, 0.1), toReal(below(4) == 0 ? 0 : mass * between(0.01, 1))});
        }
    }

    void setEnabled()
    {
        Body body = anyBody();
        if (body.isAlive()) body.setEnabled(!body.isEnabled());
    }

    void setLocks()
    {
        Body body = anyBody();
        const bool x = below(4) == 0, y = below(4) == 0, rotation = below(4) == 0;
        if (body.isAlive()) body.setLocks(x, y, rotation);
    }

    void setDamping()
    {
        Body body = anyBody();
        const double linear = below(2) * between(0, 3);
        if (!body.isAlive()) return;
        body.setLinearDamping(toReal(linear));
        body.setAngularDamping(toReal(below(2) * between(0, 3)));
    }

    void wake()
    {
        Body body = anyBody();
        if (body.isAlive()) body.wake();
    }

    void putToSleep()
    {
        Body body = anyBody();
        if (body.isAlive()) body.sleep();
    }

    void allowSleep()
    {
        Body body = anyBody();
        if (body.isAlive()) body.setAllowSleep(below(4) != 0);
        if (below(20) == 0) world_.setAllowSleep(below(3) != 0);
    }

    void push()
    {
        Body body = anyBody();
        if (!body.isAlive()) return;
        // Near the body: a far one, thrown out by an open wall, would be asked to spin without measure.
        // Light ones would be asked for more speed than there is, and refuse.
        const real mass = body.mass();
        const Vec2 impulse = mass * anyVelocity();
        const double x = between(-0.2, 0.2);
        // Nor may it be as fast as can be, as one of locked axes whose joint leaves no other way than a spin.
        const bool isRacing = length(body.linearVelocity()) > 1e5f || std::abs(body.angularVelocity()) > 1e5f;
        if (!isRacing && body.inertia() > mass / 100)
            body.applyImpulse(impulse, body.centerOfMass() + DVec2{x, 0.1});
    }

    void pushOn()
    {
        Body body = anyBody();
        if (!body.isAlive()) return;
        const Vec2 force = (10 * body.mass()) * anyVelocity();
        switch (below(4)) {
        case 0:
            body.addForce({.force = force, .forceTurns = below(2) == 0});
            break;
        case 1:
            body.clearForces();
            break;
        default:
            body.applyForceToCenter(force);
            break;
        }
    }

    void setGravity()
    {
        const double x = between(-3, 3);
        world_.setGravity(vec(x, between(-10, 2)));
    }

    void changeLaws()
    {
        if (!laws_.empty() && below(2) == 0) {
            // A body that was destroyed took its laws along.
            try {
                world_.removeForceLaw(laws_.back());
            } catch (const InputError&) {
            }
            laws_.pop_back();
            return;
        }
        Body body = anyBody();
        if (body.isAlive())
            laws_.push_back(below(2) == 0 ? body.addForceLaw(springTo(anyPlace(), 1, 0.1))
                                          : world_.addForceLaw(drag(0.1, 0.01)));
    }

    // Walls hold joints, too.
    void createJoint()
    {
        constexpr std::size_t kMostJoints = 40;
        const std::vector<BodyId> ids = world_.bodies();
        const BodyId a = ids[static_cast<std::size_t>(below(static_cast<int>(ids.size())))];
        const Body b = anyBody();
        JointDef def;
        def.kind = anyKind();
        def.collideConnected = below(3) == 0;
        def.enabled = below(8) != 0;
        if (below(4) == 0) def.breaking.force = toReal(between(1, 500));
        if (below(8) == 0) def.breaking.error = toReal(between(0.01, 1));
        if (def.breaking != JointBreaking{})
            def.breaking.window = toReal(def.breaking.force < 100 ? 0.05 : 0);
        if (!b.isAlive() || a == b.id() || world_.jointCount() >= kMostJoints) return;
        def.bodyA = below(2) == 0 ? a : b.id();
        def.bodyB = def.bodyA == a ? b.id() : a;
        if (isPushed(a) || isPushed(b.id()))
            world_.createJoint(def);
        else
            EXPECT_THROW(world_.createJoint(def), InputError);
    }

    void destroyJoint()
    {
        Joint joint = anyJoint();
        if (joint.isAlive()) joint.destroy();
    }

    void setKind()
    {
        Joint joint = anyJoint();
        const JointKind kind = anyKind();
        if (joint.isAlive()) joint.setKind(kind);
    }

    void changeJoint()
    {
        Joint joint = anyJoint();
        if (!joint.isAlive()) return;
        switch (below(4)) {
        case 0:
            joint.setEnabled(!joint.isEnabled());
            break;
        case 1:
            joint.setCollideConnected(below(2) == 0);
            break;
        case 2:
            joint.setBreaking({.torque = toReal(between(1, 500))});
            break;
        default:
            // Bodies may have become static since.
            if (isPushed(joint.bodyA()) || isPushed(joint.bodyB())) {
                const JointDef twin = world_.createJoint(joint.definition()).definition();
                EXPECT_EQ(twin.kind.index(), joint.kind().index());
            }
            break;
        }
        const JointReading reading = joint.reading();
        EXPECT_TRUE(isFinite(reading.force) && std::isfinite(reading.torque) && std::isfinite(reading.error));
    }

    Random random_;
    int weights_ = 0;
    int steps_ = 0;
    std::vector<ForceLawId> laws_;
};

}  // namespace tamias2d::test
