// SPDX-License-Identifier: MIT
// An impact may throw a body at what nothing was expected to reach in the step: grounds that have no row yet,
// and groups that sleep. They come in as they are at the start of the tick.

#include "solver/newcomers.hpp"

#include "contacts/rows.hpp"
#include "solver/integrate.hpp"

#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {

void enter(ImpactStage& stage, std::uint32_t body, const StepContext& context)
{
    Table<Motion>& rows = stage.motions.rows;
    stage.motions.rowOf[body] = static_cast<std::uint32_t>(rows.size());
    rows.push_back(motionOf(stage.world.bodies, body));
    stage.islands.islandOf.push_back(Islands::kNone);
    stage.scratch.flights.push_back(flightOf(rows.back(), context.invH));
    stage.scratch.flies.push_back(1);
    stage.system.groupOf.resize(rows.size(), JointSystem::kNone);
    TickRows& lanes = stage.rows;
    lanes.predicted.emplace_back();  // has no box to leave
    lanes.predicted.back().slack = std::numeric_limits<real>::max();
    lanes.origins.push_back({rows.back().center});
    lanes.kicks.resize(rows.size());
    lanes.changes.resize(rows.size());
    lanes.ways.resize(rows.size());
    lanes.poses.push_back(poseRow(rows.back(), rows.back().center));
    for (Table<LaneRow>* each : {&lanes.starts, &lanes.velocities})
        each->push_back(laneRow(velocityOf(rows.back())));
    for (Table<LaneRow>* each :
         {&lanes.steady, &lanes.expected, &lanes.loads, &lanes.turned, &lanes.pushes, &lanes.spans})
        each->resize(rows.size());
}

namespace {

// As a contact that has been in the step from the start is at this point of a tick.
void bringIn(ImpactStage& stage, Contact c)
{
    c.stepImpulse = {};
    c.impacts = 0;
    c.fastestImpact = 0;
    for (ContactPointRow& point : c.points) point.stepNormal = point.stepTangent = 0;
    startLoose(c, stage.motions, stage.rows);
    stage.contacts.order.push_back(static_cast<std::uint32_t>(stage.contacts.rows.size()));
    stage.contacts.rows.push_back(c);
}

// Grounds that joints hold the sleepers to.
void bringInPartners(ImpactStage& stage, const SleepGroup& sleepers, const StepContext& context)
{
    for (const std::uint32_t body : sleepers.bodies) {
        for (const std::uint32_t slot : stage.joints.of(body)) {
            const JointRow& joint = stage.joints.rows[slot];
            joint.eachBody([&](std::uint32_t other) {
                const bool isMissing = stage.motions.rowOf[other] == MotionTable::kNone;
                if (joint.ties() && isMissing && stage.world.bodies.rows[other].enabled)
                    enter(stage, other, context);
            });
        }
    }
}

}  // namespace

void rouse(ImpactStage& stage, std::uint32_t group, const StepContext& context, double time)
{
    const SleepGroup& sleepers = stage.asleep.groups[group];
    MotionTable& motions = stage.motions;
    const std::size_t first = motions.rows.size();
    const std::uint32_t island = stage.islands.count();
    stage.islands.groundOf.push_back(Islands::kNone);
    stage.islands.sizeOf.push_back(static_cast<std::uint32_t>(sleepers.bodies.size()));
    for (const std::uint32_t body : sleepers.bodies) {
        enter(stage, body, context);
        Motion& m = motions.rows.back();
        if (m.moves()) stage.islands.islandOf.back() = island;
        startDamping(m, context.h);
        stage.lawFaults += accelerateOne(m, stage.world.bodies, stage.field, time);
    }
    for (Contact c : sleepers.contacts) {
        for (const std::uint32_t shape : {c.shapeA, c.shapeB}) {
            const std::uint32_t body = stage.world.shapes.rows[shape].body;
            if (motions.rowOf[body] == MotionTable::kNone) enter(stage, body, context);
        }
        c.rowA = motions.rowOf[stage.world.shapes.rows[c.shapeA].body];
        c.rowB = motions.rowOf[stage.world.shapes.rows[c.shapeB].body];
        bringIn(stage, c);
        // Whatever they rest on holds still, so one of several grounds stands for all.
        const bool onA = !motions.rows[c.rowA].moves(), onB = !motions.rows[c.rowB].moves();
        if (onA || onB) stage.islands.groundOf[island] = onA ? c.rowA : c.rowB;
    }
    bringInPartners(stage, sleepers, context);
    for (std::size_t row = first; row < motions.rows.size(); ++row)
        takeSteady(motions.rows[row], stage.rows.steady[row]);
    stage.hinges.store(stage.system, stage.joints);
    bringInJoints(stage.joints, stage.world.bodies, motions, stage.system, first);
    for (std::size_t row = first; row < motions.rows.size(); ++row) {
        Motion& m = motions.rows[row];
        limitSteady(m, context);
        stage.rows.steady[row] = steadyRow(m);
        stage.scratch.flights[row] = flightOf(m, context.invH);
    }
    stage.roused.push_back(group);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
