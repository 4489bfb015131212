// SPDX-License-Identifier: MIT
#include "joints/own.hpp"

#include <tamias2d/math/scalar.hpp>

#include <cmath>
#include <exception>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr double kMostPart = 1e6, kMostError = 1e9, kMostOwnSpeed = 1e6, kMostStiffness = 1e15;
constexpr int kMostRigid = 3, kMostOwnLimits = 3, kMostOfAKind = 3, kMostForces = 4;

std::uint32_t slotOf(const JointRow& joint, int body)
{
    if (body == 0) return joint.bodyA;
    return body == 1 ? joint.bodyB : joint.more[static_cast<std::size_t>(body) - 2];
}

int bodiesOf(const JointRow& joint)
{
    return joint.bodyA == joint.bodyB ? 1 : 2 + static_cast<int>(joint.more.size());
}

const CountedAngle& countedAngle(const JointRow& joint, int body)
{
    return joint.angles[static_cast<std::size_t>(body)];
}

ConstraintBody viewOf(const BodyRow& body, Position center, double angle, double start, const Rot& rotation)
{
    const Vec2 inverse = body.invMass();
    const real mass = maximum(inverse.x, inverse.y), inertia = body.invInertia();
    return {center,
            angle,
            angle - start,
            rotation,
            body.localCenter,
            mass > 0 ? 1 / mass : real(0),
            inertia > 0 ? 1 / inertia : real(0)};
}

// --- what was answered

bool isWithin(double value, double most)
{
    return absolute(value) <= most;
}

void checkRow(ConstraintRows& answer, const ConstraintRows::Data& row, int i, int bodies)
{
    const auto expect = [&](bool holds, const char* field, double value, const char* rule) {
        if (!holds) answer.complain(field, value, rule, i);
    };
    expect(isWithin(row.error, kMostError), "error", row.error, "must be finite and within +-1e9");
    for (int k = 0; k < bodies; ++k) {
        const ConstraintRows::Part& part = row.parts[static_cast<std::size_t>(k)];
        for (const real number : {part.linear.x, part.linear.y, part.turn})
            expect(isWithin(static_cast<double>(number), kMostPart), "direction", static_cast<double>(number),
                   "must be finite and within +-1e6");
    }
    const auto of = [](real number) { return static_cast<double>(number); };
    expect(of(row.stiffness) >= 0 && of(row.stiffness) <= kMostStiffness, "stiffness", of(row.stiffness),
           "must be in [0, 1e15]");
    expect(of(row.damping) >= 0 && of(row.damping) <= kMostStiffness, "damping", of(row.damping),
           "must be in [0, 1e15]");
    expect(isWithin(of(row.speed), kMostOwnSpeed), "speed", of(row.speed), "must be finite and within +-1e6");
    expect(row.most >= 0 && row.most <= kUnlimited, "force", of(row.most), "must be in [0, kUnlimited]");
}

void checkAnswer(ConstraintRows& answer, int bodies)
{
    int counts[4] = {};
    for (int i = 0; i < answer.count(); ++i) {
        checkRow(answer, answer[i], i, bodies);
        ++counts[static_cast<std::size_t>(answer[i].kind)];
    }
    const auto count = [&](RowKind kind) { return counts[static_cast<std::size_t>(kind)]; };
    const int springs = count(RowKind::Spring), motors = count(RowKind::Motor);
    if (count(RowKind::Rigid) > kMostRigid)
        answer.complain("rigid", count(RowKind::Rigid), "must be at most 3 rows");
    if (count(RowKind::Limit) > kMostOwnLimits)
        answer.complain("limit", count(RowKind::Limit), "must be at most 3 rows");
    if (maximum(springs, motors) > kMostOfAKind || springs + motors > kMostForces)
        answer.complain("spring", springs + motors,
                        "must be at most 3 springs and 3 motors, together no more than 4 rows");
    checkRow(answer, answer.reading(), -1, bodies);
}

// --- rows made of it

Jacobian jacobianOf(const ConstraintRows::Data& row, int bodies)
{
    const ConstraintRows::Part &first = row.parts[0], &second = row.parts[1];
    if (bodies == 1) return {{}, first.linear, 0, first.turn};
    return {first.linear, second.linear, first.turn, second.turn};
}

// Rigid rows, limits, springs and motors have places among the joint's impulses each; springs from below,
// motors from above.
class Slots {
public:
    int of(RowKind kind)
    {
        switch (kind) {
        case RowKind::Rigid:
            return JointSlot::kBlock + rigid_++;
        case RowKind::Limit:
            return JointSlot::kLower + limits_++;
        case RowKind::Spring:
            return JointSlot::kSpring + springs_++;
        case RowKind::Motor:
            break;
        }
        return JointSlot::kMotor - motors_++;
    }

private:
    int rigid_ = 0, limits_ = 0, springs_ = 0, motors_ = 0;
};

void addOwn(const ConstraintRows::Data& from, int bodies, Slots& slots, JointRows& out, MoreBodies* more)
{
    ConstraintRow& row = out.add(from.kind, slots.of(from.kind), jacobianOf(from, bodies),
                                 static_cast<real>(from.error), from.angular);
    row.bears = from.bears && from.kind == RowKind::Limit;
    row.stiffness = from.stiffness;
    row.damping = from.damping;
    row.speed = from.speed;
    row.most = from.most;
    for (int k = 2; more && k < bodies; ++k)
        more->parts[out.count - 1][k - 2] = from.parts[static_cast<std::size_t>(k)];
}

// A row that pulls two points together along the line between them ties them at a distance [eq. 13].
void findTie(const OwnPose& pose, JointRows& out)
{
    constexpr double kAlong = 1e-4;
    if (pose.count != 2 || out.rigid > 1) return;
    const DVec2 between =
        pose.bodies[1].center - pose.bodies[0].center + toDVec2(out.armB) - toDVec2(out.armA);
    const double distance = length(between);
    for (int i = 0; i < out.count; ++i) {
        const ConstraintRow& row = out.rows[i];
        const bool ties = row.kind == RowKind::Rigid || row.bears;
        if (!ties || row.j.linearA != -row.j.linearB || row.j.linearB == Vec2{}) continue;
        const bool isAlong = absolute(cross(toDVec2(row.j.linearB), between)) <=
                             kAlong * distance * length(toDVec2(row.j.linearB));
        if (!isAlong || !(2 * absolute(static_cast<double>(row.error)) <= distance)) continue;
        const Vec2 across = perpendicular(toVec2((1 / distance) * between));
        out.distance = static_cast<real>(distance);
        out.across = {-across, across, -cross(out.armA, across), cross(out.armB, across)};
        return;
    }
}

}  // namespace

OwnPose ownPoseOf(const JointRow& joint, const BodyTable& bodies)
{
    OwnPose pose;
    pose.count = bodiesOf(joint);
    for (int k = 0; k < pose.count; ++k) {
        const BodyRow& body = bodies.rows[slotOf(joint, k)];
        const CountedAngle& counted = countedAngle(joint, k);
        const double angle = countTurns(0, body.angle, counted.now);
        pose.bodies[k] = viewOf(body, body.center, angle, counted.start, body.rotation);
    }
    return pose;
}

void askConstraint(const OwnJoint& kind, const OwnPose& pose, ConstraintRows& answer, std::string* thrown)
{
#if TAMIAS_HAS_EXCEPTIONS
    try {
        kind.measure(pose.all(), answer);
    } catch (const std::exception& error) {
        if (thrown) *thrown = error.what();
        answer.complain("measure", 0, "must not throw", 0);
    } catch (...) {
        answer.complain("measure", 0, "must not throw", 0);
    }
#else
    kind.measure(pose.all(), answer);
    static_cast<void>(thrown);
#endif
    checkAnswer(answer, pose.count);
}

std::uint32_t layoutOf(const ConstraintRows& answer)
{
    std::uint32_t layout = 1;
    for (int i = 0; i < answer.count(); ++i) {
        const ConstraintRows::Data& row = answer[i];
        layout = layout << 4 | static_cast<std::uint32_t>(row.kind) | (row.angular ? 4u : 0u) |
                 (row.bears ? 8u : 0u);
    }
    return layout;
}

int blocksOf(std::uint32_t layout)
{
    int others = 0;
    bool hasRigid = false;
    for (; layout > 1; layout >>= 4) {
        const bool rigid = (layout & 3u) == static_cast<std::uint32_t>(RowKind::Rigid);
        hasRigid = hasRigid || rigid;
        others += rigid ? 0 : 1;
    }
    return others + (hasRigid ? 1 : 0);
}

bool measureOwn(const JointRow& joint, const OwnPose& pose, JointRows& out, MoreBodies* more)
{
    out.count = out.rigid = 0;
    out.distance = 0;
    ConstraintRows answer(pose.count);
    askConstraint(std::get<OwnJoint>(joint.def.kind), pose, answer);
    if (answer.problem().field || layoutOf(answer) != joint.layout) return false;
    out.armA = pose.count == 1 ? Vec2{} : answer.arm(0);
    out.armB = answer.arm(pose.count == 1 ? 0 : 1);
    for (int k = 2; more && k < pose.count; ++k) more->arms[k - 2] = answer.arm(k);
    Slots slots;
    for (const bool rigid : {true, false})
        for (int i = 0; i < answer.count(); ++i)
            if ((answer[i].kind == RowKind::Rigid) == rigid) addOwn(answer[i], pose.count, slots, out, more);
    findTie(pose, out);
    return true;
}

OwnCoordinate ownCoordinateOf(const JointRow& joint, const BodyTable& bodies)
{
    const OwnPose pose = ownPoseOf(joint, bodies);
    ConstraintRows answer(pose.count);
    askConstraint(std::get<OwnJoint>(joint.def.kind), pose, answer);
    if (answer.problem().field) return {};
    OwnCoordinate at{answer.reading().error, 0};
    for (int k = 0; k < pose.count; ++k) {
        const ConstraintRows::Part& part = answer.reading().parts[static_cast<std::size_t>(k)];
        const BodyRow& body = bodies.rows[slotOf(joint, k)];
        at.speed += dot(part.linear, body.velocity) + part.turn * body.spin;
    }
    return at;
}

void beginOwnCount(JointRow& joint, const BodyTable& bodies)
{
    joint.angles.clear();
    for (int k = 0; k < bodiesOf(joint); ++k) {
        const double angle = bodies.rows[slotOf(joint, k)].angle;
        joint.angles.push_back({angle, angle});
    }
}

void followOwnCount(JointRow& joint, const MotionTable& motions)
{
    for (int k = 0; k < bodiesOf(joint); ++k) {
        double& angle = joint.angles[static_cast<std::size_t>(k)].now;
        angle = countTurns(0, motions.rows[motions.rowOf[slotOf(joint, k)]].angle, angle);
    }
}

bool measureOwnNow(const JointRow& joint, const BodyTable& bodies, const MotionTable& motions,
                   JointRows& rows)
{
    OwnPose pose;
    pose.count = bodiesOf(joint);
    for (int k = 0; k < pose.count; ++k) {
        const Motion& m = motions.rows[motions.rowOf[slotOf(joint, k)]];
        const CountedAngle& counted = countedAngle(joint, k);
        pose.bodies[k] = viewOf(bodies.rows[m.body], m.center, counted.now, counted.start, m.rotation);
    }
    return measureOwn(joint, pose, rows, rows.more);
}

bool measureOwnAhead(const JointRow& joint, const BodyTable& bodies, const BodySet& set, real h,
                     JointRows& out)
{
    OwnPose pose;
    pose.count = bodiesOf(joint);
    for (int k = 0; k < pose.count; ++k) {
        const Motion& m = *set.motions[pose.count == 1 ? 1 : k];
        const BodyPlace place = placeAhead(m, set.velocities[pose.count == 1 ? 1 : k], h);
        const CountedAngle& counted = countedAngle(joint, k);
        const double angle = counted.now + (place.angle - m.angle);
        pose.bodies[k] = viewOf(bodies.rows[m.body], place.center, angle, counted.start, place.rotation);
    }
    MoreBodies scratch;
    return measureOwn(joint, pose, out, pose.count > 2 ? &scratch : nullptr);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
