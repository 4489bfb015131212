// SPDX-License-Identifier: MIT
#pragma once

#include "base/check.hpp"
#include "base/timer.hpp"
#include "broadphase/rest_trees.hpp"
#include "broadphase/sweep.hpp"
#include "contacts/step_manifolds.hpp"
#include "diagnostics/faults.hpp"
#include "forces/accelerations.hpp"
#include "graph/coloring.hpp"
#include "islands/links.hpp"
#include "joints/tick.hpp"
#include "model/bodies.hpp"
#include "model/contacts.hpp"
#include "model/joints.hpp"
#include "model/motion.hpp"
#include "model/reference_poses.hpp"
#include "model/shapes.hpp"
#include "model/sleep.hpp"
#include "solver/finalize.hpp"
#include "solver/solve.hpp"
#include "tasks/chunk_lists.hpp"
#include "tasks/parallel.hpp"

#include <tamias2d/world/world.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What the shapes of a body make of it.
struct MassSum {
    double mass = 0;        // [kg]
    double inertia = 0;     // about the center   [kg*m^2]
    DVec2 center;           // in the body's frame   [m]
};

/// A shape that comes to lie where it is, and whether what it meets there must wake.
struct RestingShape {
    std::uint32_t shape;   // slot
    bool rouses;
};

/// A box that moves, and what holds still on its way.
struct RestPair {
    ShapePair pair;
    std::uint32_t group;   // it sleeps in, or BodyRow::kNoGroup
};

/// What choosing who sleeps works with.
struct SleepScratch {
    struct Verdict {   // on a group, kept at its lowest row
        bool restless = false, grounded = false, drifts = false;
        std::uint32_t group = BodyRow::kNoGroup;
    };
    std::vector<std::uint32_t> parent;   // by row
    std::vector<Verdict> verdicts;       // by row
};

/// How many there are, for the report.
struct Census {
    std::uint32_t bodies = 0, dynamicBodies = 0, shapes = 0;   // enabled, or of enabled bodies
};

/// Who must be solved together and who may be side by side, and what finding out works with.
struct GraphScratch {
    std::vector<bool> movable;   // by row: can anything push it?
    bool groundsMove = false;    // does any of the others move?
    bool hasJoints = false;
    std::vector<Link> links;
    Islands islands;             // by load or touch
    Islands crowds;              // of all that meet
    std::vector<RowPair> pairs;         // by contact
    std::vector<Nearness> nearness;     // likewise
    ColorScratch colors;
};

/// How many rows of the tables of steps were in use at once, ever.
struct MostRows {
    std::size_t contacts = 0, motions = 0, boxes = 0, pairs = 0;
};

/// All that one World owns.
struct World::Impl {
    explicit Impl(const WorldDef& def, std::uint32_t number)
        : id(number), settings(def), bodies(number, def.memory), shapes(number, def.memory), joints(number),
          lawIds(number), resting(def.memory), parallel(def.threads, def.tasks, profile), paths(def.lanes),
          solverScratch(def.lanes, parallel)
    {
    }

    std::uint32_t id;                       // part of every handle: another world's are refused
    WorldDef settings;
    double time = 0;                        // [s]
    std::uint64_t steps = 0;

    BodyTable bodies;
    ShapeTable shapes;
    ContactTable contacts;          // of bodies that take part
    bool contactsAreSorted = true;
    void sortContacts();
    void leaveLanes();
    JointTable joints;
    bool uncoupledIsStale = false;
    SleepTable asleep;
    bool lawsHeldSleepers = false;  // when they were last asked
    IdPool<ForceLawId> lawIds;
    std::vector<PlacedLaw> laws;

    // What holds still, for the questions of what moves and of users. Brought in line by settle().
    RestTrees resting;                          // of enabled bodies that take no part in steps
    std::vector<RestingShape> toPlace;          // shapes that belong there and are not there yet
    std::vector<std::uint32_t> staleMasses;     // bodies
    bool partsAreSorted = true;
    std::vector<std::uint32_t> leavers;         // bodies that took part in the last step and do no more
    Census census;
    MostRows most;

    // Of the last step.
    StepReport report;
    std::vector<TouchEvent> begins, ends, endsOfDestroyed;
    std::vector<HitEvent> hits;
    std::vector<BreakEvent> breaks;
    double stepTime = 0;                    // [s]

    Profile profile;
    Parallel parallel;

    // Scratch that keeps its memory from step to step.
    MotionTable motions;
    Table<SweepBox> boxes;
    std::vector<std::uint32_t> chunkStarts;
    std::vector<ClearRoom> clearRooms;  // by number of the MoverRow: around where a body moves
    bool isClear(std::size_t first, std::size_t end);
    ChunkLists<RestPair> foundResting;  // by chunk of boxes
    std::vector<ShapePair> restPairs;  // of a box and what holds still
    std::vector<std::uint32_t> met;  // groups
    std::vector<std::uint32_t> roused;  // groups
    SleepScratch sleepScratch;
    std::vector<ShapePair> pairs, foundPairs;
    ReferencePoses references;  // of bodies that hardly move

    // Are the contacts those of `pairs`, and would these be found again for the same boxes? Whoever changes
    // anything but how bodies move says no. And are the boxes those that pairs were looked for among?
    bool pairsAreCurrent = false, boxesAreSwept = false;
    bool sleepersAreNear = false;  // in the boxes of what moves
    std::uint64_t restingChanges = 0;  // when pairs were last looked for
    std::vector<std::uint32_t> rowBodies;  // by row
    SweepScratch sweepScratch;
    ExpectedPaths paths;  // of bodies within the step
    ManifoldScratch manifoldScratch;
    FinalScratch finalScratch;
    MatchScratch matchScratch;
    GraphScratch graph;
    std::vector<ImpactRecord> impacts;
    SolverScratch solverScratch;
    JointSystem jointSystem;
    UncoupledPairs uncoupled;

    ForceField field() const
    {
        return {settings.gravity, static_cast<double>(settings.gravitationConstant), laws};
    }
    ContactWorld contactWorld() const
    {
        return {bodies,
                shapes,
                motions,
                settings.frictionMixing,
                settings.restitutionMixing,
                settings.tuning.restGap,
                uncoupled};
    }

    BodyRow& row(BodyId body) { return bodies.rows[body.index]; }
    const BodyRow& row(BodyId body) const { return bodies.rows[body.index]; }

    // world/body_life.cpp: the only code that touches all tables.
    BodyId createBody(const BodyDef& def);
    void destroyBody(BodyId id);
    ShapeId createShape(BodyId body, const ShapeDef& def);
    void shapeAdded(BodyRow& body, std::uint32_t slot);
    void destroyShape(std::uint32_t slot);
    JointId createJoint(const JointDef& def, std::uint32_t layout);
    void destroyJoint(std::uint32_t slot);
    void removeShape(std::uint32_t slot);
    void makeMassStale(std::uint32_t bodySlot);
    void updateMass(std::uint32_t bodySlot);
    static constexpr std::uint32_t kNoShape = 0xffffffffu;
    MassSum massOfShapes(const BodyRow& body, std::uint32_t slot = kNoShape,
                         const ShapeDef* def = nullptr) const;
    Complaint checkMassWith(std::string_view field, const ShapeDef& def, std::uint32_t bodySlot,
                            std::uint32_t slot = kNoShape) const;
    void moveCenter(std::uint32_t bodySlot, Position origin, Vec2 before, Vec2 center);
    void rebuildConvex(std::uint32_t shapeSlot);
    void endContacts(std::uint32_t shapeSlot);
    TouchEvent touchEvent(const Contact& contact) const;
    ContactView view(const Contact& contact) const;

    // world/joint_checks.cpp, joint_kind_checks.cpp: `layout` becomes that of a constraint of one's own, else
    // 0.
    Complaint check(const JointDef& def, std::uint32_t& layout) const;
    Complaint checkKind(const JointDef& def, const JointKind& kind, std::uint32_t& layout) const;
    Complaint checkBodies(const JointDef& def) const;

    // world/parts.cpp: who takes part in steps, and what holds still.
    void tally(const BodyRow& body, bool comes);
    void refreshPart(std::uint32_t bodySlot);
    void place(std::uint32_t shapeSlot, bool rouses);
    void placeAgain(std::uint32_t shapeSlot);
    void placeAll(std::uint32_t bodySlot, bool rouses);
    void displaceAll(std::uint32_t bodySlot);
    void settleMass(std::uint32_t bodySlot);
    void settle();

    void placeEverything();

    // world/world_reading.cpp
    template <class Holds>
    bool anyContact(std::uint32_t bodyA, std::uint32_t bodyB, Holds holds) const;

    // world/sleep.cpp: who falls asleep.
    bool maySleep() const { return settings.allowSleep && !(settings.gravitationConstant > 0); }
    void fallAsleep(const StepContext& context);
    void makeAsleep(std::uint32_t bodySlot);
    bool sleepNow(std::uint32_t bodySlot);
    void storeContacts();

    // world/wake.cpp: who wakes.
    void wake(std::uint32_t bodySlot);
    void wakeGroup(std::uint32_t group, bool withContacts = true);
    void wakeAll();
    void disturb(std::uint32_t bodySlot);
    void disturbShape(std::uint32_t shapeSlot);
    void forceComes(std::uint32_t bodySlot);
    void wakeTouching(std::uint32_t bodySlot, std::uint32_t shapeSlot = kNoShape);
    void wakeNear(std::uint32_t shapeSlot);
    void wakeAmong(std::vector<std::uint32_t>& shapeSlots);
    void wakeByLaws(std::uint32_t& faults);
    void askLaws(const SleepGroup& group, double at, std::vector<std::array<double, 3>>& answers,
                 std::uint32_t& faults) const;
    void noteLaws(std::uint32_t group, double at);

    // world/joint_life.cpp
    void disturbJoint(std::uint32_t jointSlot);
    void listUncoupled();

    // world/boxes.cpp
    void forgetKept(const BodyRow& body);
    void expectWays(std::size_t begin, std::size_t end, const StepContext& context);
    bool sweepBody(std::size_t row, const StepContext& context, SweepBox* next);
    void sweepStill(std::size_t row, const StepContext& context);
    bool sweepBodies(const StepContext& context);

    // world/gather.cpp: the bodies of a step, and who may meet.
    void noteRows();
    bool rowsAreKept() const;
    void predictSteady();
    void gatherPartners();
    void findRestPairs(const ContactWorld& world);
    std::uint32_t gather(const ForceField& forces, const StepContext& context);

    // world/memory.cpp
    void noteMost();
    MemoryReport memory() const;

    // world/validate.cpp
    void validate(Faults& faults) const;

    // world/step.cpp
    void breakJoints();
    StepReport step(double dt, int substeps);
    void rememberLeavers();
    void setAside();
};

// world/checks.cpp: what is wrong with a definition, if anything.
Complaint check(const WorldDef& def);
Complaint check(const Tuning& tuning);
Complaint check(const Material& material);
Complaint check(const MassProperties& mass, real lengthUnit);
Complaint checkMass(std::string_view field, std::string value, const MassSum& mass);
Complaint check(const BodyDef& def, real lengthUnit);
/// `known`: the geometry has been checked.
Complaint check(const ShapeDef& def, real lengthUnit, bool known = false);
Complaint check(const LastingForce& force, real lengthUnit);
Complaint check(const JointKind& kind, real lengthUnit);
Complaint check(const JointBreaking& breaking);
Complaint checkPosition(std::string_view field, Position position, real lengthUnit);
Complaint checkVelocity(std::string_view field, Vec2 velocity, real lengthUnit);
Complaint checkSpin(std::string_view field, real spin);
Complaint checkThreads(std::string_view field, int threads);
Complaint checkMixingRule(std::string_view field, MixingRule rule, bool worldAllowed);

/// Raises what was complained about; true if there was something (in builds without exceptions).
bool refuse(const Complaint& complaint);

}  // namespace tamias2d::inline TAMIAS_PRECISION
