// SPDX-License-Identifier: MIT
#include "diagnostics/energy.hpp"
#include "diagnostics/validate.hpp"
#include "joints/reading.hpp"
#include "queries/search.hpp"
#include "world/impl.hpp"

#include <algorithm>
#include <atomic>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

std::uint32_t nextWorldNumber()
{
    static std::atomic<std::uint32_t> last{0};
    return ++last;
}

template <class IdType>
Complaint checkAlive(std::string_view field, bool alive, const IdType& id, std::string_view what)
{
    const std::string given =
        id.isNull() ? "null" : textOf(id.index) + " (generation " + textOf(id.generation) + ")";
    if (alive) return std::nullopt;
    return InputError(std::string(field), given, "must be a live " + std::string(what) + " of this world");
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

// --- results

StepEvents World::events() const noexcept
{
    return {impl_->begins, impl_->ends, impl_->hits, impl_->breaks};
}

ContactView World::Impl::view(const Contact& c) const
{
    const TouchEvent pair = touchEvent(c);
    ContactView view;
    view.shapeA = pair.shapeA;
    view.shapeB = pair.shapeB;
    view.bodyA = pair.bodyA;
    view.bodyB = pair.bodyB;
    view.normal = c.normal;
    view.pointCount = c.count;
    view.touching = c.touching;
    view.impulse = c.stepImpulse;
    view.restGap = c.restGap;
    view.friction = c.friction;
    view.restitution = c.restitution;
    const Position centerA = bodies.rows[shapes.rows[c.shapeA].body].center;
    for (int i = 0; i < c.count; ++i) {
        const ContactPointRow& point = c.points[i];
        view.points[static_cast<std::size_t>(i)] = {centerA + toDVec2(point.armA), point.gap + c.restGap,
                                                    point.stepNormal, point.stepTangent,
                                                    point.anchor.feature};
    }
    return view;
}

std::vector<ContactView> World::contacts() const
{
    std::vector<const Contact*> rows;
    for (const Contact& c : impl_->contacts.rows)
        if (c.count > 0 || c.stepImpulse != Vec2{}) rows.push_back(&c);
    for (const SleepGroup& group : impl_->asleep.groups)
        for (const Contact& c : group.contacts) rows.push_back(&c);
    std::sort(rows.begin(), rows.end(), [](const Contact* a, const Contact* b) {
        return a->shapeA != b->shapeA ? a->shapeA < b->shapeA : a->shapeB < b->shapeB;
    });
    std::vector<ContactView> all;
    for (const Contact* c : rows) all.push_back(impl_->view(*c));
    return all;
}

// Is there such a contact of the body? Those of one that sleeps are in its group.
template <class Holds>
bool World::Impl::anyContact(std::uint32_t bodyA, std::uint32_t bodyB, Holds holds) const
{
    for (const std::uint32_t body : {bodyA, bodyB}) {
        if (!bodies.rows[body].isAsleep()) continue;
        const auto& all = asleep.groups[bodies.rows[body].group].contacts;
        if (std::any_of(all.begin(), all.end(), holds)) return true;
    }
    return std::any_of(contacts.rows.begin(), contacts.rows.end(), holds);
}

bool World::touching(BodyId a, BodyId b) const
{
    if (refuse(checkAlive("a", impl_->bodies.ids.owns(a), a, "body"))) return false;
    if (refuse(checkAlive("b", impl_->bodies.ids.owns(b), b, "body"))) return false;
    return impl_->anyContact(a.index, b.index, [&](const Contact& c) {
        const std::uint32_t first = impl_->shapes.rows[c.shapeA].body,
                            second = impl_->shapes.rows[c.shapeB].body;
        return c.touching &&
               ((first == a.index && second == b.index) || (first == b.index && second == a.index));
    });
}

bool World::touching(ShapeId a, ShapeId b) const
{
    if (refuse(checkAlive("a", impl_->shapes.ids.owns(a), a, "shape"))) return false;
    if (refuse(checkAlive("b", impl_->shapes.ids.owns(b), b, "shape"))) return false;
    const std::uint32_t bodyA = impl_->shapes.rows[a.index].body, bodyB = impl_->shapes.rows[b.index].body;
    return impl_->anyContact(bodyA, bodyB, [&](const Contact& c) {
        return c.touching && c.shapeA == minimum(a.index, b.index) && c.shapeB == maximum(a.index, b.index);
    });
}

Energy World::energy() const
{
    Energy sum = totalEnergy(impl_->bodies, impl_->field(), impl_->time);
    sum.potential += springEnergy(impl_->joints, impl_->bodies);
    return sum;
}
Momentum World::momentum() const
{
    return totalMomentum(impl_->bodies);
}

std::vector<std::string> World::validate() const
{
    Faults faults;
    impl_->validate(faults);
    return faults.found();
}

// --- queries

std::vector<ShapeId> World::queryPoint(Position point, const Filter& filter) const
{
    if (refuse(checkFinite("point", point, "must be finite m"))) return {};
    impl_->settle();
    return shapesAt({impl_->bodies, impl_->shapes, impl_->resting, filter}, point);
}

std::vector<ShapeId> World::queryBox(const Aabb& box, const Filter& filter) const
{
    if (Checks()
            .finite("box.lower", box.lower, "must be finite m")
            .finite("box.upper", box.upper, "must be finite m")
            .that(box.lower.x <= box.upper.x && box.lower.y <= box.upper.y, "box.lower", box.lower,
                  "must not exceed box.upper")
            .refuse())
        return {};
    impl_->settle();
    return shapesIn({impl_->bodies, impl_->shapes, impl_->resting, filter}, box);
}

std::optional<RayHit> World::castRay(Position from, Position to, const Filter& filter) const
{
    const std::vector<RayHit> hits = castRayAll(from, to, filter);
    if (hits.empty()) return std::nullopt;
    return hits.front();
}

std::vector<RayHit> World::castRayAll(Position from, Position to, const Filter& filter) const
{
    if (Checks().finite("from", from, "must be finite m").finite("to", to, "must be finite m").refuse())
        return {};
    impl_->settle();
    return shapesAlong({impl_->bodies, impl_->shapes, impl_->resting, filter}, from, to);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
