// SPDX-License-Identifier: MIT
#include "solver/contact_passes.hpp"

#include "contacts/rows.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

void prepareLoose(Contact& c, const MotionTable& motions)
{
    prepareContact(c, motions.rows[c.rowA], motions.rows[c.rowB]);
    for (int i = 0; i < c.count; ++i) c.points[i].wasLoaded = c.points[i].normalImpulse > 0;
}

bool isAny(const std::vector<std::uint8_t>& flags)
{
    return std::find(flags.begin(), flags.end(), std::uint8_t{1}) != flags.end();
}

bool isNewlyLoaded(const Contact& c)
{
    for (int k = 0; k < c.count; ++k)
        if (!c.points[k].wasLoaded && c.points[k].normalImpulse > 0) return true;
    return false;
}

}  // namespace

void startLoose(Contact& c, const MotionTable& motions, TickRows& rows)
{
    prepareLoose(c, motions);
    LaneRow &a = rows.steady[c.rowA], &b = rows.steady[c.rowB];
    BodyMotion<real> steadyA = velocityOf(a), steadyB = velocityOf(b);
    addSteady(loadOf(c), motions.rows[c.rowA], motions.rows[c.rowB], steadyA, steadyB);
    bool loaded = false;
    for (int k = 0; k < c.count; ++k) loaded = loaded || c.points[k].wasLoaded;
    a = laneRow(steadyA, loaded ? real(1) : a.w);
    b = laneRow(steadyB, loaded ? real(1) : b.w);
}

void ContactPasses::use(LaneWidth width, ContactTable& contacts)
{
    if (width == width_) return;
    leave(contacts);
    lanes_ = makeContactLanes(width, parallel_);
    width_ = width;
}

void ContactPasses::tell(ContactTable& contacts)
{
    if (!isTold_) lanes_->tellAll(contacts.rows);
    isTold_ = true;
}

void ContactPasses::leave(ContactTable& contacts)
{
    if (areLeft_) return;
    tell(contacts);
    std::fill(inLane_.begin(), inLane_.end(), std::uint8_t{0});
    areLeft_ = true;
}

void ContactPasses::release(const std::vector<std::uint8_t>& which, ContactTable& contacts)
{
    for (std::uint32_t i = 0; i < which.size(); ++i) {
        if (which[i] == 0 || !isInLane(i)) continue;
        if (!isTold_) lanes_->tell(i, contacts.rows[i]);
        lanes_->drop(i);
        inLane_[i] = 0;
    }
}

void ContactPasses::begin(ContactTable& contacts, const MotionTable& motions, const Islands& islands,
                          const TickRows& rows, const StepContext& context, bool same,
                          const std::vector<std::uint8_t>& renewed)
{
    const std::size_t count = contacts.rows.size();
    islands_ = &islands;
    loose_.clear();
    // They change places.
    loose_.reserve(contacts.rows.capacity());
    outLoose_.reserve(contacts.rows.capacity());
    for (std::vector<std::uint8_t>* byIsland : {&unrest_, &visited_})
        byIsland->reserve(motions.rows.capacity());
    changes_.reserve(motions.rows.capacity());
    settling_.reserve(motions.rows.capacity());
    isLoose_.resize(count);
    inLane_.resize(count);
    if (same && !areLeft_ && lanes_->fits(contacts.rows, renewed, context)) {
        lanes_->carryOn(islands, rows);
    } else {
        leave(contacts);
        colorEnds_ = contacts.colorEnds;
        placeOf_.resize(count);
        for (std::uint32_t k = 0; k < contacts.order.size(); ++k) placeOf_[contacts.order[k]] = k;
        lanes_->build(contacts, motions, islands, context);
    }
    isTold_ = true;  // until the step is over, of what is in no lane
    areLeft_ = false;
    parallel_.forEach(count, kContactGrain, [&](const Chunk& chunk) {
        for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
            isLoose_[i] = 0;
            if (inLane_[i] != 0) continue;
            Contact& c = contacts.rows[i];
            c.impacts = 0;
            c.stepImpulse = {};
            for (ContactPointRow& point : c.points) point.stepNormal = point.stepTangent = 0;
            isLoose_[i] = c.count > 0 ? 1 : 0;
        }
    });
    for (std::uint32_t i = 0; i < count; ++i)
        if (isLoose_[i] != 0) loose_.push_back(i);
}

void ContactPasses::end(ContactTable& contacts, const std::vector<std::uint32_t>& swept)
{
    if (anySitsOut_) lanes_->comeIn();
    anySitsOut_ = false;
    for (const std::uint32_t i : swept) leaveLane(i, contacts.rows[i]);
    isTold_ = false;
}

ContactEndCounts ContactPasses::conclude(const TickRows& rows, const StepContext& context,
                                         ContactTable& contacts, std::vector<std::uint32_t>& changed)
{
    changed.clear();
    return areLeft_ ? ContactEndCounts{} : lanes_->conclude(rows, context, contacts, changed);
}

void ContactPasses::addLoose(std::uint32_t contact)
{
    if (isLoose_.size() <= contact) isLoose_.resize(contact + 1, 0);
    if (isLoose_[contact] != 0) return;
    isLoose_[contact] = 1;
    loose_.push_back(contact);
}

void ContactPasses::take(std::uint32_t contact, ContactTable& contacts)
{
    leaveLane(contact, contacts.rows[contact]);
    addLoose(contact);
}

// Back into the lanes with what has become plain again.
void ContactPasses::fillLanes(ContactTable& contacts, const MotionTable& motions, const TickRows& rows)
{
    constexpr std::uint8_t kPlain = 2;
    list_.swap(loose_);
    loose_.clear();
    parallel_.forEach(list_.size(), kContactGrain, [&](const Chunk& chunk) {
        for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
            const std::uint32_t i = list_[k];
            Contact& c = contacts.rows[i];
            c.impacts = 0;
            c.fastestImpact = 0;
            isLoose_[i] = c.count == 0                                           ? 0
                          : lanes_->hasLane(i) && isPlain(c) && !piles_.holds(i) ? kPlain
                                                                                 : 1;
        }
    });
    const bool many = list_.size() > contacts.rows.size() / 4;
    if (many) lanes_->loadMarked(isLoose_, kPlain, contacts.rows, motions, rows);
    for (const std::uint32_t i : list_) {
        if (isLoose_[i] == 1) loose_.push_back(i);
        if (isLoose_[i] != kPlain) continue;
        if (!many) lanes_->load(i, contacts.rows[i], motions, rows);
        isLoose_[i] = 0;
        inLane_[i] = 1;
    }
}

void ContactPasses::prepare(ContactTable& contacts, const MotionTable& motions, TickRows& rows,
                            const StepContext& context, const JointSystem* joints)
{
    fillLanes(contacts, motions, rows);
    if (joints != nullptr && !joints->guarded.empty()) {
        const auto isGuarded = [&](std::uint32_t row) { return joints->isGuarded(row, motions.rows[row]); };
        for (std::uint32_t i = 0; i < contacts.rows.size(); ++i) {
            const Contact& c = contacts.rows[i];
            if (isInLane(i) && (isGuarded(c.rowA) || isGuarded(c.rowB))) take(i, contacts);
        }
    }
    rows.steady.assign(motions.rows.size(), {});
    list_.clear();
    for (std::size_t p = 0; p < piles_.count(); ++p)
        for (const std::uint32_t i : piles_[p].contacts)
            if (isInLane(i) && !lanes_->sitsOut(i)) take(i, contacts);
    lanes_->prepare(rows, context, list_);
    for (const std::uint32_t i : list_) take(i, contacts);
    sortLoose();
    for (const std::uint32_t i : loose_) startLoose(contacts.rows[i], motions, rows);
}

const std::vector<std::uint32_t>& ContactPasses::approaching(const TickRows& rows, const StepContext& context,
                                                             real fastest)
{
    lanes_->findApproaching(rows, context, fastest, list_);
    list_.insert(list_.end(), loose_.begin(), loose_.end());
    return list_;
}

void ContactPasses::loosen(std::uint32_t contact, ContactTable& contacts, const MotionTable& motions)
{
    Contact& c = contacts.rows[contact];
    if (leaveLane(contact, c)) {
        c.fastestImpact = 0;
        prepareContact(c, motions.rows[c.rowA], motions.rows[c.rowB]);
    }
    addLoose(contact);
}

bool ContactPasses::leaveLane(std::uint32_t contact, Contact& c)
{
    if (contact >= inLane_.size() || inLane_[contact] == 0) return false;
    inLane_[contact] = 0;
    lanes_->unload(contact, c);
    return true;
}

void ContactPasses::sortLoose()
{
    std::sort(loose_.begin(), loose_.end(),
              [this](std::uint32_t a, std::uint32_t b) { return placeOf(a) < placeOf(b); });
    looseEnds_.clear();
    std::uint32_t at = 0;
    for (int color = 0; color < lanes_->colors(); ++color) {
        while (at < loose_.size() && placeOf(loose_[at]) < colorEnds_[static_cast<std::size_t>(color)]) ++at;
        looseEnds_.push_back(at);
    }
}

// Color by color: the lanes of it, then what is loose of it; then what has no color to itself.
template <class OfColor, class OfLoose>
void ContactPasses::visitColors(OfColor ofColor, OfLoose ofLoose)
{
    std::uint32_t at = 0;
    for (int color = 0; color < lanes_->colors(); ++color) {
        ofColor(color);
        for (; at < looseEnds_[static_cast<std::size_t>(color)]; ++at) ofLoose(loose_[at]);
    }
    for (; at < loose_.size(); ++at) ofLoose(loose_[at]);
}

void ContactPasses::solve(ContactTable& contacts, MotionTable& motions, TickRows& rows,
                          const StepContext& context, const Unrest& limit, const JointWorld* world,
                          JointSystem* joints)
{
    sortLoose();
    for (int pass = 0;; ++pass) {
        if (pass <= limit.extraPasses) {
            visited_.swap(unrest_);
            unrest_.assign(islands_->count(), 0);
        } else {
            for (std::size_t i = 0; i < unrest_.size(); ++i) unrest_[i] &= ~visited_[i] & 1u;
        }
        const bool isLast = pass >= limit.extraPasses;  // but for what settles
        if (isLast) changes_.assign(islands_->count(), 0);
        const UnrestNotes notes{unrest_.data(), isLast ? changes_.data() : nullptr};
        const std::uint8_t* const visited = pass == 0 ? limit.islands : visited_.data();
        if (joints != nullptr)
            passOverJoints(*world, *joints, limit.restless, visited, rows.velocities, unrest_);
        visitColors(
            [&](int color) { lanes_->pass(color, rows, visited, notes, limit.restless, limit.ofAny); },
            [&](std::uint32_t i) {
                if (piles_.holds(i)) return;
                Contact& c = contacts.rows[i];
                const std::uint32_t island = islandOf(*islands_, c.rowA, c.rowB);
                if (visited != nullptr && visited[island] == 0) return;
                LaneRow &rowA = rows.velocities[c.rowA], &rowB = rows.velocities[c.rowB];
                Motion &a = motions.rows[c.rowA], &b = motions.rows[c.rowB];
                setVelocity(a, velocityOf(rowA));
                setVelocity(b, velocityOf(rowB));
                real change = solveContact(c, a, b, context);
                if (limit.ofAny)
                    change =
                        maximum(change, maximum(changeBetween(velocityOf(rowA), velocityOf(a), a.extent),
                                                changeBetween(velocityOf(rowB), velocityOf(b), b.extent)));
                if (change > limit.restless) {
                    unrest_[island] = 1;
                    if (isLast) ++changes_[island];
                }
                setVelocity(rowA, velocityOf(a));
                setVelocity(rowB, velocityOf(b));
            });
        const bool left =
            joints != nullptr && !piles_.empty() &&
            piles_.pass(0, visited == nullptr, contacts, *world, *joints, rows.velocities, unrest_);
        if (isLast ? !chooseSettling(pass, motions, rows, context, limit) : !left && !isAny(unrest_)) break;
    }
}

// Chooses the islands of further passes beyond extraPasses: large ones that have nearly come to rest and are
// restless at large, as loads of a tall pile find their way by some layers in a pass. docs/theory/calm.md,
// section 4. Returns whether there are any.
bool ContactPasses::chooseSettling(int passes, const MotionTable& motions, const TickRows& rows,
                                   const StepContext& context, const Unrest& limit)
{
    constexpr real kSettling = 3;  // what has nearly come to rest is slower than so many times calmSpeed
    constexpr std::uint32_t kBodies = 4;  // a changed contact for so many is restless at large
    if (passes >= limit.settlingPasses || !isAny(unrest_)) return false;
    visited_.assign(unrest_.size(), 0);
    for (std::size_t i = 0; i < visited_.size(); ++i) {
        const std::uint32_t bodies = islands_->sizeOf[i];
        if (bodies >= SettlingIslands::kLarge && kBodies * changes_[i] > bodies) visited_[i] = 1;
    }
    if (!isAny(visited_)) return false;
    if (passes == limit.extraPasses)
        settling_.find(*islands_, motions.rows, rows.velocities, kSettling * context.calmSpeed());
    for (std::uint32_t i = 0; i < visited_.size(); ++i)
        if (visited_[i] != 0 && !settling_.holds(i)) visited_[i] = 0;
    return isAny(visited_);
}

void ContactPasses::takeOut(std::uint32_t contact, ContactTable& contacts, const MotionTable& motions)
{
    if (isInLane(contact)) lanes_->leaveSums(contact);
    loosen(contact, contacts, motions);
}

void ContactPasses::solveAgain(ContactTable& contacts, MotionTable& motions, TickRows& rows,
                               const std::vector<std::uint8_t>& islands, const JointWorld& world,
                               JointSystem& joints)
{
    const Tuning& tuning = world.context.tuning;
    const Unrest limit{tuning.extraPasses, tuning.settlingPasses, tuning.restless * world.context.lengthUnit,
                       false, islands.data()};
    solve(contacts, motions, rows, world.context, limit, &world, &joints);
}

void ContactPasses::addUp(ContactTable& contacts, const MotionTable& motions, const StepContext& context)
{
    for (const std::uint32_t i : loose_) addToSums(contacts.rows[i], 1);
    piles_.forgetBlows(contacts, motions, context);
}

const std::vector<std::uint32_t>& ContactPasses::newlyLoaded(const ContactTable& contacts)
{
    lanes_->findNewlyLoaded(list_);
    for (const std::uint32_t i : loose_)
        if (isNewlyLoaded(contacts.rows[i])) list_.push_back(i);
    std::sort(list_.begin(), list_.end(),
              [this](std::uint32_t a, std::uint32_t b) { return placeOf(a) < placeOf(b); });
    return list_;
}

void ContactPasses::keep(const ContactTable& contacts)
{
    lanes_->keep();
    sortLoose();
    kept_.clear();
    for (const std::uint32_t i : loose_) kept_.push_back(contacts.rows[i]);
}

void ContactPasses::restore(ContactTable& contacts)
{
    lanes_->restore();
    for (std::size_t k = 0; k < loose_.size(); ++k) contacts.rows[loose_[k]] = kept_[k];
}

void ContactPasses::pushApart(ContactTable& contacts, MotionTable& motions, TickRows& rows,
                              const StepContext& context, ClampCounts& clamps, const JointWorld* world,
                              const JointSystem* joints)
{
    visitColors([&](int color) { lanes_->push(color, rows, context, clamps); },
                [&](std::uint32_t i) {
                    if (piles_.holds(i)) return;
                    Contact& c = contacts.rows[i];
                    BodyMotion<real> a = velocityOf(rows.pushes[c.rowA]), b = velocityOf(rows.pushes[c.rowB]);
                    pushContact(c, motions.rows[c.rowA], motions.rows[c.rowB], a, b, context, clamps);
                    rows.pushes[c.rowA] = laneRow(a);
                    rows.pushes[c.rowB] = laneRow(b);
                });
    if (joints != nullptr && !piles_.empty())
        piles_.pushApart(contacts, *world, *joints, rows.pushes, clamps);
    visitColors([&](int color) { lanes_->repay(color, rows, context); },
                [&](std::uint32_t i) {
                    Contact& c = contacts.rows[i];
                    LaneRow &a = rows.velocities[c.rowA], &b = rows.velocities[c.rowB];
                    Vec2 velocityA{a.x, a.y}, velocityB{b.x, b.y};
                    repayPush(c, motions.rows[c.rowA], motions.rows[c.rowB], velocityA, velocityB, context);
                    a.x = velocityA.x, a.y = velocityA.y;
                    b.x = velocityB.x, b.y = velocityB.y;
                });
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
