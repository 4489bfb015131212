// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/error.hpp>
#include <tamias2d/base/profile.hpp>
#include <tamias2d/diagnostics/energy.hpp>
#include <tamias2d/forces/force_law.hpp>
#include <tamias2d/geometry/aabb.hpp>
#include <tamias2d/model/defs.hpp>
#include <tamias2d/model/events.hpp>
#include <tamias2d/queries/queries.hpp>
#include <tamias2d/tasks/task_system.hpp>
#include <tamias2d/world/joint.hpp>
#include <tamias2d/world/memory.hpp>
#include <tamias2d/world/report.hpp>

#include <concepts>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

class World;
class Body;

/// The definition of a joint of your own on bodies, for a name, breaking and such.
template <class T, std::same_as<Body>... More>
JointDef constraintOf(const T& constraint, const Body& first, const More&... more);

/// A reference to one shape of one World, cheap to copy; the twin of Body. Store a ShapeId.
///
/// On a dead handle every call but id() and isAlive() raises InputError and changes nothing.
class Shape {
public:
    Shape() = default;  ///< a null handle

    ShapeId id() const noexcept { return id_; }
    bool isAlive() const noexcept;
    BodyId body() const;

    /// Everything about the shape, such that createShape with it makes its twin.
    ShapeDef definition() const;
    /// Replaces geometry, density, material, filter and all; the body's mass follows. Contacts go on.
    void redefine(const ShapeDef& def);

    Material material() const;
    void setMaterial(const Material& material);
    Filter filter() const;
    void setFilter(const Filter& filter);  ///< contacts no longer allowed end at the next step
    real density() const;                  ///< [kg/m^2]
    void setDensity(real density);         ///< [kg/m^2]   >= 0
    std::uint64_t userData() const;
    void setUserData(std::uint64_t value);

    Aabb bounds() const;                     ///< where it is now          [m]
    bool contains(Position point) const;     ///< border included [T5]     [m]

    void destroy();  ///< and its contacts; the body's mass follows

private:
    friend class World;
    friend class Body;
    Shape(World* world, ShapeId id) noexcept : world_(world), id_(id) {}
    World* alive() const;  // refuses a dead handle; null then, in builds without exceptions

    World* world_ = nullptr;
    ShapeId id_;
};

/// A reference to one body of one World, cheap to copy. Store a BodyId; use a Body to act.
///
/// On a dead handle every call but id() and isAlive() raises InputError and changes nothing.
/// Every setter refuses values that are not finite or out of range the same way [R4].
class Body {
public:
    Body() = default;  ///< a null handle

    BodyId id() const noexcept { return id_; }
    bool isAlive() const noexcept;

    // --- what it is
    /// Everything about the body but its shapes and forces, such that createBody makes its twin.
    BodyDef definition() const;
    BodyType type() const;
    void setType(BodyType type);             ///< a body made static loses its velocity
    const std::string& name() const;
    void setName(std::string_view name);
    std::uint64_t userData() const;
    void setUserData(std::uint64_t value);
    bool isEnabled() const;
    void setEnabled(bool enabled);           ///< a disabled body neither moves nor collides

    // --- sleep: bodies at rest cost nothing. What changes a body, or what it rests on, wakes it and all
    // that fell asleep with it; questions do not, nor do calls that change nothing.
    /// Does it take part in steps? Static and disabled bodies do not, nor kinematic ones at rest.
    bool isAwake() const;
    /// Is it a dynamic body at rest, which costs nothing until something happens?
    bool isAsleep() const;
    /// Wakes it with all that fell asleep with it.
    void wake();
    /// Puts it to sleep as it is, with all it touches and they touch; what speed they have is lost.
    /// False, and nothing happens, if one of them may not sleep or rests on what moves, or the World
    /// has no sleep.
    bool sleep();
    bool allowsSleep() const;
    /// One that may not keeps all it touches awake.
    void setAllowSleep(bool allow);

    // --- where it is and how it moves
    Transform transform() const;             ///< of the body's origin                      [m, rad]
    Position position() const;               ///< of the body's origin                      [m]
    Position centerOfMass() const;           ///< in the world: the p of the SRS [DD1]      [m]
    double angle() const;                    ///< in [0, 2 pi)                              [rad]
    Vec2 linearVelocity() const;             ///< of the center of mass                     [m/s]
    real angularVelocity() const;            ///< counter-clockwise                         [rad/s]
    Vec2 velocityAt(Position point) const;   ///< of the body's matter at a world point [DD9]   [m/s]
    void setTransform(Position position, double angle);  ///< teleports; velocity stays     [m, rad]
    void setLinearVelocity(Vec2 velocity);   ///< [m/s]     length <= 1e6 lengthUnit
    void setAngularVelocity(real velocity);  ///< [rad/s]   |value| <= 1e6
    /// Between the poses before and after the last step: `alpha` 0 to 1. A teleport is not smeared.
    Transform interpolated(double alpha) const;

    // --- mass
    real mass() const;                       ///< [kg]      of a dynamic body; else 0, meaning infinite
    real inertia() const;                    ///< about the center of mass; 0: cannot turn  [kg*m^2]
    Vec2 localCenter() const;                ///< of mass, in the body's frame              [m]
    void setMass(const MassProperties& mass);  ///< mass > 0, inertia >= 0; stays until resetMass
    void resetMass();                        ///< from the shapes and their densities again

    // --- forces: each wants a dynamic body, else it has no effect
    void applyForce(Vec2 force, Position at);     ///< for the next step [DD13]             [N, m]
    void applyForceToCenter(Vec2 force);          ///< for the next step                    [N]
    void applyTorque(real torque);                ///< for the next step                    [N*m]
    void applyImpulse(Vec2 impulse, Position at); ///< at once [DD10]                       [N*s, m]
    void applyImpulseToCenter(Vec2 impulse);      ///< at once                              [N*s]
    void applyAngularImpulse(real impulse);       ///< at once                              [N*m*s]
    std::size_t addForce(const LastingForce& force);  ///< stays on; returns its place in lastingForces()
    std::span<const LastingForce> lastingForces() const;
    void setForce(std::size_t place, const LastingForce& force);
    void clearForces();                           ///< the lasting ones, and those for the next step
    ForceLawId addForceLaw(ForceLaw law);         ///< on this body; see World::addForceLaw for all
    real linearDamping() const;                   ///< [1/s]
    void setLinearDamping(real damping);          ///< [1/s]   >= 0
    real angularDamping() const;                  ///< [1/s]
    void setAngularDamping(real damping);         ///< [1/s]   >= 0
    real gravityScale() const;                    ///< [1]
    void setGravityScale(real scale);             ///< [1]
    std::optional<Vec2> ownGravity() const;       ///< [m/s^2]
    void setOwnGravity(std::optional<Vec2> gravity);  ///< instead of the world's           [m/s^2]
    void setLocks(bool x, bool y, bool rotation);

    // --- shapes
    Shape createShape(const ShapeDef& def);
    std::vector<Shape> shapes() const;       ///< in order of creation
    std::vector<Joint> joints() const;       ///< that hold this body, in order of creation

    // --- results
    Energy energy() const;  ///< gravitation between bodies is counted in World::energy only
    Momentum momentum() const;
    std::vector<ContactView> contacts() const;  ///< as of the last step

    void destroy();  ///< with its shapes, contacts and joints

private:
    friend class World;
    friend class Shape;
    Body(World* world, BodyId id) noexcept : world_(world), id_(id) {}
    World* alive() const;  // refuses a dead handle; null then, in builds without exceptions

    World* world_ = nullptr;
    BodyId id_;
};

/// A set of bodies, shapes and joints, and the one function that moves them: step() [R1].
///
/// The same calls in the same order give the same bits on every supported platform [ADR6], with any number of
/// threads. One thread at a time may call a World; separate Worlds share nothing.
class World {
public:
    /// @throws InputError naming the field of `def` that is wrong, its value and the rule
    explicit World(const WorldDef& def = {});
    ~World();
    World(World&&) = delete;  ///< a Body points at its World, so a World stays put

    // --- bodies, shapes and joints
    Body createBody(const BodyDef& def = {});
    void destroyBody(BodyId id);
    Body body(BodyId id);  ///< refuses a dead id
    std::optional<Body> findBody(BodyId id) noexcept;  ///< empty if dead
    std::optional<Body> findBody(std::string_view name) noexcept;  ///< the first of that name
    Shape shape(ShapeId id);  ///< refuses a dead id
    std::optional<Shape> findShape(ShapeId id) noexcept;
    std::vector<BodyId> bodies() const;  ///< sorted by id
    std::size_t bodyCount() const noexcept;
    std::size_t shapeCount() const noexcept;
    Joint createJoint(const JointDef& def);
    /// A joint of your own, on as many bodies as the constraint says: docs/guide/own-joints.md. What its
    /// function throws or answers wrongly is refused as all bad input.
    template <class T, std::same_as<Body>... More>
    Joint createJoint(const T& constraint, const Body& first, const More&... more)
    {
        return createJoint(constraintOf(constraint, first, more...));
    }
    void destroyJoint(JointId id);
    Joint joint(JointId id);  ///< refuses a dead id
    std::optional<Joint> findJoint(JointId id) noexcept;  ///< empty if dead
    std::optional<Joint> findJoint(std::string_view name) noexcept;  ///< the first of that name
    std::vector<JointId> joints() const;  ///< sorted by id
    std::size_t jointCount() const noexcept;
    void readStates(std::span<const BodyId> ids, std::span<BodyState> states) const;  ///< same length
    void writeStates(std::span<const BodyId> ids, std::span<const BodyState> states);  ///< all or none

    // --- settings
    const WorldDef& definition() const noexcept;  ///< gravity, tuning, rules as they are now
    void setGravity(Vec2 gravity);  ///< [m/s^2]
    void setGravitationConstant(real g);  ///< [m^3/(kg*s^2)]   >= 0
    void setTuning(const Tuning& tuning);
    /// False wakes all.
    void setAllowSleep(bool allow);
    void setMixingRules(MixingRule friction, MixingRule restitution);  ///< not MixingRule::World
    /// As WorldDef::threads and tasks: of the steps from now on. Wakes nothing, changes no result.
    void setThreads(int threads, TaskSystem* tasks = nullptr);
    ForceLawId addForceLaw(ForceLaw law);  ///< on every dynamic body
    void removeForceLaw(ForceLawId id);
    /// The laws in force, in order of addition, and the body each acts on (null: all).
    std::vector<std::pair<BodyId, ForceLaw>> forceLaws() const;

    // --- time
    /// Moves everything by dt, in [1e-12, 1] s, in 1 to 256 sub-steps. A bad dt or substeps is told in the
    /// report, and nothing moves.
    StepReport step(double dt = 1.0 / 60.0, int substeps = 4) noexcept;  ///< dt [s]
    double time() const noexcept;  ///< sum of all dt   [s]
    std::uint64_t stepCount() const noexcept;
    const StepReport& lastReport() const noexcept;
    /// Whether steps keep a profile: a span for each stage, and for its parts. Off at first; then it costs
    /// nothing. Changes no result.
    void setProfiling(bool on);
    /// Of the last step, each thread's in order of their begins; empty while profiling is off.
    std::span<const ProfileSpan> profile() const noexcept;

    /// How much memory the tables hold, and how full they have been: docs/guide/memory.md.
    MemoryReport memory() const noexcept;

    // --- results
    StepEvents events() const noexcept;  ///< of the last step
    std::vector<ContactView> contacts() const;  ///< sorted by shape ids, as of the last step
    bool touching(BodyId a, BodyId b) const;  ///< as of the last step [R7]
    bool touching(ShapeId a, ShapeId b) const;
    Energy energy() const;  ///< of all enabled dynamic bodies
    Momentum momentum() const;  ///< of all enabled dynamic bodies
    /// One number for the whole state: equal hashes mean equal bits, on every platform.
    std::uint64_t stateHash() const noexcept;
    /// What is wrong inside the world, a line each, like "bodies[3].velocity = (nan, 0): must be finite";
    /// empty if every invariant of its tables holds. Always empty, unless there is a bug: for tests, and for
    /// reports of bugs. Takes time in proportion to the world, and memory.
    std::vector<std::string> validate() const;

    // --- queries, at the present poses [R7]
    std::vector<ShapeId> queryPoint(Position point, const Filter& filter = {}) const;  ///< sorted
    std::vector<ShapeId> queryBox(const Aabb& box,
                                  const Filter& filter = {}) const;  ///< sorted; by exact shape
    std::optional<RayHit> castRay(Position from, Position to, const Filter& filter = {}) const;
    std::vector<RayHit> castRayAll(Position from, Position to,
                                   const Filter& filter = {}) const;  ///< by fraction

private:
    friend class Body;
    friend class Shape;
    friend class Joint;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

template <class T, std::same_as<Body>... More>
JointDef constraintOf(const T& constraint, const Body& first, const More&... more)
{
    if constexpr (CountsBodies<T>)
        static_assert(T::bodies == 1 + sizeof...(More), "give as many bodies as the constraint has");
    const BodyId ids[] = {first.id(), more.id()...};
    JointDef def;
    def.kind = OwnJoint(constraint);
    def.bodyA = ids[0];
    def.bodyB = ids[std::size(ids) > 1 ? 1 : 0];
    if constexpr (sizeof...(More) > 1) def.moreBodies.assign(std::begin(ids) + 2, std::end(ids));
    return def;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
