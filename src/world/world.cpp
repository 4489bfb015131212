// SPDX-License-Identifier: MIT
// World: its beginning, its bodies and shapes, its settings, and time.

#include "world/check_alive.hpp"
#include "world/impl.hpp"

#include <atomic>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

std::uint32_t nextWorldNumber()
{
    static std::atomic<std::uint32_t> last{0};
    return ++last;
}

}  // namespace

World::World(const WorldDef& def)
{
    const bool bad = refuse(check(def));
    impl_ = std::make_unique<Impl>(bad ? WorldDef{} : def, nextWorldNumber());
}

World::~World() = default;

// --- bodies and shapes

Body World::createBody(const BodyDef& def)
{
    if (refuse(check(def, impl_->settings.lengthUnit))) return {};
    return {this, impl_->createBody(def)};
}

void World::destroyBody(BodyId id)
{
    if (refuse(checkAlive("BodyId", impl_->bodies.ids.owns(id), id, "body"))) return;
    impl_->destroyBody(id);
}

Body World::body(BodyId id)
{
    if (refuse(checkAlive("BodyId", impl_->bodies.ids.owns(id), id, "body"))) return {};
    return {this, id};
}

std::optional<Body> World::findBody(BodyId id) noexcept
{
    if (!impl_->bodies.ids.owns(id)) return std::nullopt;
    return Body(this, id);
}

std::optional<Body> World::findBody(std::string_view name) noexcept
{
    for (std::uint32_t slot = 0; slot < impl_->bodies.rows.size(); ++slot)
        if (impl_->bodies.ids.isAlive(slot) && impl_->bodies.extra(impl_->bodies.rows[slot]).name == name)
            return Body(this, impl_->bodies.ids.id(slot));
    return std::nullopt;
}

Shape World::shape(ShapeId id)
{
    if (refuse(checkAlive("ShapeId", impl_->shapes.ids.owns(id), id, "shape"))) return {};
    return {this, id};
}

std::optional<Shape> World::findShape(ShapeId id) noexcept
{
    if (!impl_->shapes.ids.owns(id)) return std::nullopt;
    return Shape(this, id);
}

std::vector<BodyId> World::bodies() const
{
    std::vector<BodyId> all;
    for (std::uint32_t slot = 0; slot < impl_->bodies.rows.size(); ++slot)
        if (impl_->bodies.ids.isAlive(slot)) all.push_back(impl_->bodies.ids.id(slot));
    return all;
}

std::size_t World::bodyCount() const noexcept
{
    return impl_->bodies.ids.alive();
}
std::size_t World::shapeCount() const noexcept
{
    return impl_->shapes.ids.alive();
}

void World::readStates(std::span<const BodyId> ids, std::span<BodyState> states) const
{
    Checks checks;
    checks.that(ids.size() == states.size(), "states.size", states.size(), "must equal the number of ids");
    for (const BodyId& id : ids) checks.add(checkAlive("ids", impl_->bodies.ids.owns(id), id, "body"));
    if (checks.refuse()) return;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const BodyRow& b = impl_->row(ids[i]);
        states[i] = {b.origin(), b.angle, b.velocity, b.spin};
    }
}

void World::writeStates(std::span<const BodyId> ids, std::span<const BodyState> states)
{
    const real unit = impl_->settings.lengthUnit;
    Checks checks;
    checks.that(ids.size() == states.size(), "states.size", states.size(), "must equal the number of ids");
    for (const BodyId& id : ids) checks.add(checkAlive("ids", impl_->bodies.ids.owns(id), id, "body"));
    for (const BodyState& s : states)
        checks.add(checkPosition("BodyState.position", s.position, unit))
            .finite("BodyState.angle", s.angle, "must be finite rad")
            .add(checkVelocity("BodyState.linearVelocity", s.linearVelocity, unit))
            .add(checkSpin("BodyState.angularVelocity", s.angularVelocity));
    if (checks.refuse()) return;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        Body b(this, ids[i]);
        b.setTransform(states[i].position, states[i].angle);
        b.setLinearVelocity(states[i].linearVelocity);
        b.setAngularVelocity(states[i].angularVelocity);
    }
}

// --- settings

const WorldDef& World::definition() const noexcept
{
    return impl_->settings;
}

void World::setGravity(Vec2 gravity)
{
    if (refuse(checkFinite("gravity", gravity, "must be finite m/s^2"))) return;
    if (gravity != impl_->settings.gravity) impl_->wakeAll();
    impl_->settings.gravity = gravity;
}

void World::setGravitationConstant(real g)
{
    if (refuse(checkRange("gravitationConstant", g, 0, kAnyFinite, "must be finite and >= 0 m^3/(kg*s^2)")))
        return;
    if (g != impl_->settings.gravitationConstant) impl_->wakeAll();
    impl_->settings.gravitationConstant = g;
}

void World::setTuning(const Tuning& tuning)
{
    if (refuse(check(tuning))) return;
    if (tuning == impl_->settings.tuning) return;
    impl_->wakeAll();
    impl_->settings.tuning = tuning;
    impl_->references.forgetAll();
    impl_->pairsAreCurrent = false;
    impl_->placeEverything();
}

void World::setMixingRules(MixingRule friction, MixingRule restitution)
{
    if (refuse(checkMixingRule("frictionMixing", friction, false))) return;
    if (refuse(checkMixingRule("restitutionMixing", restitution, false))) return;
    if (friction != impl_->settings.frictionMixing || restitution != impl_->settings.restitutionMixing)
        impl_->wakeAll();
    impl_->settings.frictionMixing = friction;
    impl_->settings.restitutionMixing = restitution;
    impl_->pairsAreCurrent = false;
}

void World::setAllowSleep(bool allow)
{
    if (!allow) impl_->wakeAll();
    impl_->settings.allowSleep = allow;
}

void World::setThreads(int threads, TaskSystem* tasks)
{
    if (refuse(checkThreads("threads", threads))) return;
    if (threads == impl_->settings.threads && tasks == impl_->settings.tasks) return;
    impl_->settings.threads = threads;
    impl_->settings.tasks = tasks;
    impl_->parallel.use(threads, tasks);
}

ForceLawId World::addForceLaw(ForceLaw law)
{
    if (refuse(checkThat(static_cast<bool>(law.force), "ForceLaw.force", "empty", "must be a function")))
        return {};
    const ForceLawId id = impl_->lawIds.take();
    impl_->laws.push_back({id, {}, std::move(law)});
    return id;
}

void World::removeForceLaw(ForceLawId id)
{
    if (refuse(checkAlive("ForceLawId", impl_->lawIds.owns(id), id, "force law"))) return;
    std::erase_if(impl_->laws, [&](const PlacedLaw& placed) { return placed.id == id; });
    impl_->lawIds.giveBack(id.index);
}

std::vector<std::pair<BodyId, ForceLaw>> World::forceLaws() const
{
    std::vector<std::pair<BodyId, ForceLaw>> all;
    for (const PlacedLaw& placed : impl_->laws) all.emplace_back(placed.body, placed.law);
    return all;
}

// --- time

// Out of memory there is nothing to go on with. NOLINTNEXTLINE(bugprone-exception-escape)
StepReport World::step(double dt, int substeps) noexcept
{
    if (!(dt >= 1e-12 && dt <= 1) || substeps < 1 || substeps > 256) {
        impl_->report = {};
        impl_->report.status = StepStatus::BadTimeStep;
        impl_->report.substeps = 0;
        return impl_->report;
    }
    return impl_->report = impl_->step(dt, substeps);
}

double World::time() const noexcept
{
    return impl_->time;
}
std::uint64_t World::stepCount() const noexcept
{
    return impl_->steps;
}
const StepReport& World::lastReport() const noexcept
{
    return impl_->report;
}

void World::setProfiling(bool on)
{
    impl_->profile.setOn(on);
}
std::span<const ProfileSpan> World::profile() const noexcept
{
    return impl_->profile.spans();
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
