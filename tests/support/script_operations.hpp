// SPDX-License-Identifier: MIT
// What a random script can do.
#pragma once

#include "support/script_choices.hpp"

#include <gtest/gtest.h>

namespace tamias2d::test {

/// Each thing that can be done; RandomScript says how often.
class ScriptOperations : public ScriptChoices {
protected:
    using ScriptChoices::ScriptChoices;

    virtual void afterStep(const StepReport&) {}

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

    int steps_ = 0;

private:
    std::vector<ForceLawId> laws_;
};

}  // namespace tamias2d::test
