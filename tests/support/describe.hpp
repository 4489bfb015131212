// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/tamias2d.hpp>

#include <ios>
#include <sstream>
#include <string>

// Every definition of a world as text, so that a test can ask "is anything different?" in one line. Numbers
// are written to the last bit.
namespace tamias2d::test {

inline std::ostream& operator<<(std::ostream& out, Vec2 v)
{
    return out << '(' << v.x << ' ' << v.y << ')';
}
inline std::ostream& operator<<(std::ostream& out, Position p)
{
    return out << '(' << p.x << ' ' << p.y << ')';
}

inline void write(std::ostream& out, const Geometry& geometry)
{
    if (const auto* circle = std::get_if<Circle>(&geometry)) {
        out << "circle " << circle->center << ' ' << circle->radius;
    } else if (const auto* capsule = std::get_if<Capsule>(&geometry)) {
        out << "capsule " << capsule->a << capsule->b << ' ' << capsule->radius;
    } else if (const auto* segment = std::get_if<Segment>(&geometry)) {
        out << "segment " << segment->a << segment->b << ' ' << segment->radius;
    } else {
        const auto& polygon = std::get<Polygon>(geometry);
        out << "polygon ";
        for (const Vec2 v : polygon.points()) out << v;
        out << ' ' << polygon.radius;
    }
}

inline void write(std::ostream& out, const ShapeDef& def)
{
    const Material& m = def.material;
    out << "  shape ";
    write(out, def.geometry);
    out << " offset " << def.offset << " angle " << def.angle << " density " << def.density << " friction "
        << m.friction << " restitution " << m.restitution << " rolling " << m.rollingResistance << " surface "
        << m.surfaceSpeed << " mixing " << int(m.frictionMixing) << ' ' << int(m.restitutionMixing)
        << " filter " << def.filter.category << ' ' << def.filter.mask << ' ' << def.filter.group << " data "
        << def.userData << '\n';
}

inline void write(std::ostream& out, const BodyDef& def)
{
    out << "body \"" << def.name << "\" type " << int(def.type) << " at " << def.position << " angle "
        << def.angle << " velocity " << def.linearVelocity << " spin " << def.angularVelocity << " damping "
        << def.linearDamping << ' ' << def.angularDamping << " gravity " << def.gravityScale << " locks "
        << def.lockX << def.lockY << def.lockRotation << " enabled " << def.enabled << " sleep "
        << def.allowSleep << " awake " << def.awake << " data " << def.userData;
    if (def.gravity) out << " own gravity " << *def.gravity;
    if (def.mass) out << " mass " << def.mass->mass << def.mass->center << ' ' << def.mass->inertia;
    out << '\n';
}

inline void write(std::ostream& out, const WorldDef& def)
{
    const Tuning& t = def.tuning;
    out << "world gravity " << def.gravity << " G " << def.gravitationConstant << " unit " << def.lengthUnit
        << " mixing " << int(def.frictionMixing) << ' ' << int(def.restitutionMixing) << " tuning "
        << t.restGap << ' ' << t.touchingFactor << ' ' << t.pushRate << ' ' << t.pushSpeed << ' '
        << t.pushSlack << ' ' << t.extraPasses << ' ' << t.settlingPasses << ' ' << t.restless << ' '
        << t.calmRate << ' ' << t.calmSpeed << ' ' << t.quiet << ' ' << t.impactThreshold << ' ' << t.crowd
        << ' ' << t.impactsPerContact << ' ' << t.sleepTime << ' ' << t.sleepSpeed << " sleep "
        << def.allowSleep << '\n';
}

/// All numbers of a kind are in the state's hash; here is what is not, and which kind it is.
inline void write(std::ostream& out, const JointDef& def)
{
    out << "joint \"" << def.name << "\" kind " << def.kind.index() << " of " << def.bodyA.index << ' '
        << def.bodyB.index << " collide " << def.collideConnected << " enabled " << def.enabled
        << " breaks at " << def.breaking.force << ' ' << def.breaking.torque << ' ' << def.breaking.error
        << " for " << def.breaking.window << " data " << def.userData << '\n';
}

/// The world, its laws, bodies, lasting forces, shapes and joints.
inline std::string describe(World& world)
{
    std::ostringstream out;
    out << std::hexfloat;
    write(out, world.definition());
    out << "time " << world.time() << " steps " << world.stepCount() << '\n';
    for (const auto& [body, law] : world.forceLaws())
        out << "law " << law.name << " on " << body.index << '\n';
    for (const BodyId id : world.bodies()) {
        const Body body = world.body(id);
        write(out, body.definition());
        for (const LastingForce& f : body.lastingForces()) {
            out << "  force " << f.force << " at " << f.point << ' ' << f.forceTurns << f.pointTurns << ' '
                << f.torque << '\n';
        }
        for (const Shape& shape : body.shapes()) write(out, shape.definition());
    }
    for (const JointId id : world.joints()) write(out, world.joint(id).definition());
    return out.str();
}

}  // namespace tamias2d::test
