// SPDX-License-Identifier: MIT
#pragma once

#include "base/check.hpp"
#include "broadphase/sweep.hpp"
#include "contacts/update.hpp"
#include "forces/accelerations.hpp"
#include "model/bodies.hpp"
#include "model/contacts.hpp"
#include "model/motion.hpp"
#include "model/shapes.hpp"
#include "solver/solve.hpp"

#include <tamias2d/world/world.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What the shapes of a body make of it.
struct MassSum {
    double mass = 0;        // [kg]
    double inertia = 0;     // about the center   [kg*m^2]
    DVec2 center;           // in the body's frame   [m]
};

/// All that one World owns.
struct World::Impl {
    explicit Impl(const WorldDef& def, std::uint32_t number)
        : id(number), settings(def), bodies(number), shapes(number), lawIds(number)
    {
    }

    std::uint32_t id;                       // part of every handle: another world's are refused
    WorldDef settings;
    double time = 0;                        // [s]
    std::uint64_t steps = 0;

    BodyTable bodies;
    ShapeTable shapes;
    ContactTable contacts;
    IdPool<ForceLawId> lawIds;
    std::vector<PlacedLaw> laws;

    // Of the last step.
    StepReport report;
    std::vector<TouchEvent> begins, ends, endsOfDestroyed;
    std::vector<HitEvent> hits;

    // Scratch that keeps its memory from step to step.
    MotionTable motions;
    std::vector<SweepBox> boxes;
    std::vector<ShapePair> pairs;
    SweepScratch sweepScratch;
    ExpectedPaths paths;
    std::vector<ImpactRecord> impacts;
    SolverScratch solverScratch;

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
                settings.tuning.restGap};
    }

    BodyRow& row(BodyId body) { return bodies.rows[body.index]; }
    const BodyRow& row(BodyId body) const { return bodies.rows[body.index]; }

    // world/body_life.cpp: the only code that touches all tables.
    BodyId createBody(const BodyDef& def);
    void destroyBody(BodyId id);
    ShapeId createShape(BodyId body, const ShapeDef& def);
    void destroyShape(std::uint32_t slot);
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

    // world/step.cpp
    StepReport step(double dt, int substeps);
};

// world/checks.cpp: what is wrong with a definition, if anything.
Complaint check(const WorldDef& def);
Complaint check(const Tuning& tuning);
Complaint check(const Material& material);
Complaint check(const MassProperties& mass, real lengthUnit);
Complaint checkMass(std::string_view field, std::string value, const MassSum& mass);
Complaint check(const BodyDef& def, real lengthUnit);
Complaint check(const ShapeDef& def, real lengthUnit);
Complaint check(const LastingForce& force, real lengthUnit);
Complaint checkPosition(std::string_view field, Position position, real lengthUnit);
Complaint checkVelocity(std::string_view field, Vec2 velocity, real lengthUnit);
Complaint checkSpin(std::string_view field, real spin);
Complaint checkMixingRule(std::string_view field, MixingRule rule, bool worldAllowed);

/// Raises what was complained about; true if there was something (in builds without exceptions).
bool refuse(const Complaint& complaint);

}  // namespace tamias2d::inline TAMIAS_PRECISION
