// SPDX-License-Identifier: MIT
// What a random script chooses by chance: places, things that are there, definitions of new ones.
#pragma once

#include "support/build.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace tamias2d::test {

/// A world within four walls, and chance.
class ScriptChoices {
protected:
    ScriptChoices(std::uint32_t seed, const WorldDef& def) : world_(def), random_(seed)
    {
        addWalls(world_, {-8, 0}, {8, 10}, {.restitution = 0.3});
    }

    double between(double a, double b) { return random_.between(a, b); }
    int below(int n) { return std::min(static_cast<int>(between(0, n)), n - 1); }

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

    World world_;

private:
    Random random_;
};

}  // namespace tamias2d::test
