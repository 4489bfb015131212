// SPDX-License-Identifier: MIT
// Definitions of joints between two bodies as they are.

#include "joints/pose.hpp"

#include <tamias2d/world/world.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Bodies, the anchors of one place on both, and the angle between them.
template <class Kind>
JointDef holdAt(const Body& a, const Body& b, Position anchor, Kind kind)
{
    kind.anchorA = toLocal(a.transform(), anchor);
    kind.anchorB = toLocal(b.transform(), anchor);
    kind.referenceAngle = b.angle() - a.angle();
    return jointOf(a, b, kind);
}

}  // namespace

JointDef revoluteAt(const Body& a, const Body& b, Position anchor)
{
    return holdAt(a, b, anchor, RevoluteJoint{});
}

JointDef weldAt(const Body& a, const Body& b, Position anchor)
{
    return holdAt(a, b, anchor, WeldJoint{});
}

JointDef slideAlong(const Body& a, const Body& b, Position anchor, Vec2 axis)
{
    PrismaticJoint kind;
    kind.axis = inverseRotate(a.transform().rotation, axis);
    return holdAt(a, b, anchor, kind);
}

JointDef rodBetween(const Body& a, const Body& b, Position onA, Position onB)
{
    DistanceJoint kind;
    kind.anchorA = toLocal(a.transform(), onA);
    kind.anchorB = toLocal(b.transform(), onB);
    kind.length = static_cast<real>(length(onB - onA));
    return jointOf(a, b, kind);
}

JointDef dragAt(const Body& hand, const Body& b, Position point)
{
    TargetJoint kind;
    kind.anchor = toLocal(b.transform(), point);
    kind.target = point;
    return jointOf(hand, b, kind);
}

JointDef wheelAt(const Body& chassis, const Body& wheel, Position hub, Vec2 axis)
{
    WheelJoint kind;
    kind.anchorA = toLocal(chassis.transform(), hub);
    kind.anchorB = toLocal(wheel.transform(), hub);
    kind.axis = inverseRotate(chassis.transform().rotation, axis);
    return jointOf(chassis, wheel, kind);
}

JointDef grooveBetween(const Body& a, const Body& b, Position start, Position end, Position onB)
{
    GrooveJoint kind;
    kind.start = toLocal(a.transform(), start);
    kind.end = toLocal(a.transform(), end);
    kind.anchorB = toLocal(b.transform(), onB);
    return jointOf(a, b, kind);
}

JointDef gearBetween(const Body& a, const Body& b, real ratio)
{
    return jointOf(a, b, GearJoint{ratio, b.angle() - static_cast<double>(ratio) * a.angle()});
}

JointDef rackAlong(const Body& rack, const Body& pinion, Vec2 axis, real radius)
{
    const Position center = pinion.centerOfMass();
    RackJoint kind;
    kind.anchorA = toLocal(rack.transform(), center);
    kind.anchorB = toLocal(pinion.transform(), center);
    kind.axis = inverseRotate(rack.transform().rotation, axis);
    kind.radius = radius;
    kind.offset = -static_cast<double>(radius) * countTurns(rack.angle(), pinion.angle(), 0);
    return jointOf(rack, pinion, kind);
}

JointDef pulleyOver(const Body& a, const Body& b, Position onA, Position onB, Position wheelA,
                    Position wheelB, real ratio)
{
    PulleyJoint kind;
    kind.anchorA = toLocal(a.transform(), onA);
    kind.anchorB = toLocal(b.transform(), onB);
    kind.wheelA = wheelA;
    kind.wheelB = wheelB;
    kind.ratio = ratio;
    kind.length = static_cast<real>(length(onA - wheelA) + static_cast<double>(ratio) * length(onB - wheelB));
    return jointOf(a, b, kind);
}

JointDef jointOf(const Body& a, const Body& b, const JointKind& kind)
{
    JointDef def;
    def.bodyA = a.id();
    def.bodyB = b.id();
    def.kind = kind;
    return def;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
