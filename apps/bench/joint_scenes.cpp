// SPDX-License-Identifier: MIT
// The scenes of Box2D's benchmark suite that need joints, from their published dimensions
// (github.com/erincatto/box2d, shared/benchmarks.c and shared/human.c, 2026): numbers only.

#include "suite_scenes.hpp"

#include "engine.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace tamias2d::bench {
namespace {

constexpr double kPi = std::numbers::pi;

SceneBody ground(std::vector<SceneShape> shapes = {})
{
    return {Mobility::Fixed, {}, false, std::move(shapes)};
}

SceneBody freeAt(Vec position, std::vector<SceneShape> shapes)
{
    return {Mobility::Free, {position}, false, std::move(shapes)};
}

// A ragdoll: a tree of bones, each hinged to its parent at a point.
struct Bone {
    int parent;
    double y;                ///< of the bone above the soles   [m]
    double from, to, radius; ///< of its capsule, upright       [m]
    double pivot;            ///< above the soles               [m]
    double lower, upper;     ///< bounds of its angle           [pi rad]
    double friction;         ///< factor on the torque of all
    double reference = 0;    ///< [pi rad]
    double damping = 0;
    bool foot = false;
};

constexpr Bone kBones[] = {
    {-1, 0.95, -0.02, 0.02, 0.095, 0, 0, 0, 0},                                // hip
    {0, 1.2, -0.135, 0.135, 0.09, 1.0, -0.25, 0, 0.5},                         // torso
    {1, 1.475, -0.038, 0.039, 0.075, 1.4, -0.3, 0.1, 0.25, 0, 0.1},            // head
    {0, 0.775, -0.125, 0.125, 0.06, 0.9, -0.05, 0.4, 1},                       // upper left leg
    {3, 0.475, -0.155, 0.125, 0.045, 0.625, -0.5, -0.02, 0.5, 0, 0, true},     // lower left leg
    {0, 0.775, -0.125, 0.125, 0.06, 0.9, -0.05, 0.4, 1},                       // upper right leg
    {5, 0.475, -0.155, 0.125, 0.045, 0.625, -0.5, -0.02, 0.5, 0, 0, true},     // lower right leg
    {1, 1.225, -0.125, 0.125, 0.035, 1.35, -0.1, 0.8, 0.5},                    // upper left arm
    {7, 0.975, -0.125, 0.125, 0.03, 1.1, -0.2, 0.3, 0.1, 0.25, 0.1},           // lower left arm
    {1, 1.225, -0.125, 0.125, 0.035, 1.35, -0.1, 0.8, 0.5},                    // upper right arm
    {9, 0.975, -0.125, 0.125, 0.03, 1.1, -0.2, 0.3, 0.1, 0.25, 0.1},           // lower right arm
};
constexpr std::size_t kBoneCount = std::size(kBones);

// It stands at a place and comes later. Those of one group pass through each other; feet touch no ragdoll.
void addRagdoll(Scene& scene, Vec soles, int group)
{
    constexpr double kFriction = 0.05, kFrequency = 5, kDampingRatio = 0.5;
    const std::size_t first = scene.bodies.size();
    for (const Bone& bone : kBones) {
        SceneShape limb{{{0, bone.from}, {0, bone.to}}, bone.radius, 1, 0.2, 0, {2, 1 | 2, -group}};
        SceneBody body = freeAt({soles.x, soles.y + bone.y}, {limb});
        body.damping = bone.damping;
        body.atStart = false;
        if (bone.foot) {
            SceneShape foot = polygon({{-0.03, -0.185}, {0.11, -0.185}, {0.11, -0.16}, {-0.03, -0.14}});
            foot.radius = 0.015;
            foot.friction = 0.05;
            foot.filter = {2, 1, -group};
            body.shapes.push_back(foot);
        }
        scene.bodies.push_back(body);
        if (bone.parent < 0) continue;
        const std::size_t parent = first + static_cast<std::size_t>(bone.parent);
        scene.joints.push_back({parent,
                                scene.bodies.size() - 1,
                                {0, bone.pivot - kBones[bone.parent].y},
                                {0, bone.pivot - bone.y},
                                kPi * bone.reference,
                                SceneJoint::Limits{kPi * bone.lower, kPi * bone.upper},
                                SceneJoint::Motor{0, kFriction * bone.friction},
                                SceneJoint::Spring{kFrequency, kDampingRatio}});
    }
}

// The hinge that turns a rotor about a point of the ground, which is body 0.
SceneJoint drivenHinge(std::size_t rotor, Vec pivot, double speed, double maxTorque)
{
    SceneJoint joint{0, rotor, pivot};
    joint.motor = {speed, maxTorque};
    return joint;
}

}  // namespace

Scene jointGrid()
{
    constexpr std::size_t kSide = 100;
    Scene scene{"joint_grid", 500};
    SceneShape shape = disc(0.4);
    shape.filter = {2, ~2u, 0};
    const auto isFixed = [](std::size_t column, std::size_t row) {
        return row == 0 && column >= kSide / 2 - 3 && column <= kSide / 2 + 3;
    };
    for (std::size_t column = 0; column < kSide; ++column) {
        for (std::size_t row = 0; row < kSide; ++row) {
            const std::size_t body = scene.bodies.size();
            scene.bodies.push_back(freeAt({static_cast<double>(column), -static_cast<double>(row)}, {shape}));
            if (isFixed(column, row)) scene.bodies.back().mobility = Mobility::Fixed;
            if (row > 0) scene.joints.push_back({body - 1, body, {0, -0.5}, {0, 0.5}});
            // Two that are fixed have no need of a joint, and not every engine takes one.
            if (column > 0 && !(isFixed(column, row) && isFixed(column - 1, row)))
                scene.joints.push_back({body - kSide, body, {0.5, 0}, {-0.5, 0}});
        }
    }
    return scene;
}

Scene rain()
{
    // Every eight steps one more column of groups, until all are there; then the oldest go and fall anew.
    constexpr std::size_t kRows = 5, kColumns = 40, kRagdolls = 5, kGroup = kRagdolls * kBoneCount;
    constexpr double kCell = 0.5, kSpan = 500 * kCell, kStorey = 45;
    Scene scene{"rain", 1000};
    scene.sleep = true;
    scene.bodies.push_back(ground());
    for (std::size_t row = 0; row < kRows; ++row)
        for (int i = 0; i <= 500; ++i)
            scene.bodies[0].shapes.push_back(
                box(kCell / 2, kCell / 2, {-kSpan / 2 + i * kCell, kStorey * static_cast<double>(row)}));
    for (std::size_t column = 0; column < kColumns; ++column)
        for (std::size_t row = 0; row < kRows; ++row)
            for (std::size_t i = 0; i < kRagdolls; ++i)
                addRagdoll(scene,
                           {-kSpan / 2 + kSpan / kColumns * (static_cast<double>(column) + 0.5) +
                                0.5 * static_cast<double>(i),
                            40 + kStorey * static_cast<double>(row)},
                           static_cast<int>(i) + 1);
    scene.drive = [](Engine& engine, int step) {
        if (step % 8 != 0) return;
        for (std::size_t row = 0; row < kRows; ++row) {
            const std::size_t column = static_cast<std::size_t>(step) / 8 % kColumns;
            const std::size_t from = 1 + (column * kRows + row) * kGroup, to = from + kGroup;
            for (std::size_t i = to; i-- > from;)
                if (engine.has(i)) engine.remove(i);
            for (std::size_t i = from; i < to; ++i) engine.add(i);
        }
    };
    return scene;
}

// Its wall is a loop of lines and not a chain, which some engines have not; what meets has the same
// restitution.
Scene spinner()
{
    constexpr int kLines = 360;
    Scene scene{"spinner", 500};
    scene.sleep = true;
    scene.bodies.push_back(ground());
    const auto onWall = [](int i) {
        const double angle = 2 * kPi * i / kLines;
        return Vec{40 * std::cos(angle), 32 + 40 * std::sin(angle)};
    };
    for (int i = 0; i < kLines; ++i) scene.bodies[0].shapes.push_back(line(onWall(i), onWall(i + 1)));
    SceneShape blade = box(0.4, 20);
    blade.radius = 0.2;
    scene.bodies.push_back(freeAt({0, 12}, {blade}));
    scene.bodies.back().maySleep = false;
    scene.joints.push_back(drivenHinge(1, {0, 12}, 5, std::numeric_limits<double>::infinity()));

    const SceneShape kinds[] = {capsule(0.25, 0.25), disc(0.35), box(0.35, 0.35)};
    constexpr int kInARow = 92;  // half a meter apart: they overlap at the start
    for (int i = 0; i < 2 * 3038; ++i) {
        scene.bodies.push_back(freeAt({-23 + 0.5 * (i % kInARow), 2 + 0.5 * (i / kInARow)}, {kinds[i % 3]}));
        scene.bodies.back().shapes[0].density = 0.25;
    }
    for (SceneBody& body : scene.bodies)
        for (SceneShape& shape : body.shapes) shape.friction = 0.1, shape.restitution = 0.1;
    scene.bodies[1].shapes[0].friction = 0;
    return scene;
}

Scene tumbler()
{
    constexpr int kSide = 45;
    Scene scene{"tumbler", 750};
    scene.sleep = true;
    scene.bodies.push_back(ground());
    scene.bodies.push_back(freeAt({0, 10}, {box(0.5, 10, {10, 0}), box(0.5, 10, {-10, 0}),
                                            box(10, 0.5, {0, 10}), box(10, 0.5, {0, -10})}));
    for (SceneShape& wall : scene.bodies[1].shapes) wall.density = 50;
    scene.joints.push_back(drivenHinge(1, {0, 10}, kPi / 180 * 25, 1e8));
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j)
            scene.bodies.push_back(
                freeAt({-0.2 * kSide + 0.4 * j, -0.2 * kSide + 10 + 0.4 * i}, {box(0.125, 0.125)}));
    return scene;
}

}  // namespace tamias2d::bench
