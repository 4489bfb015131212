// SPDX-License-Identifier: MIT
#include "solver/stiff_piles.hpp"

#include "contacts/rows.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr std::uint32_t kMostBodies = 300;  // of a pile that is solved at once
constexpr double kUnevenTouches = 60;       // ratio of masses that may be too much for the passes
constexpr std::size_t kMostBlocks = 200;    // of its factors, likewise
constexpr std::int8_t kPileSteps = 30;           // steps for which a pile stays so, or is not tried again
constexpr real kBears = 30;                 // times what forces do to the lighter one: a heavy load
constexpr double kNegligible = 1e-5;        // a speed at which nothing moves   [lengthUnit/s]

ConstraintRow& addDirectRow(JointRows& rows, RowKind kind, const Jacobian& j, real mass, real impulse)
{
    ConstraintRow& row = rows.rows[rows.count];
    RowVisit& visit = rows.visits[rows.count++];
    row = {};
    row.kind = kind;
    row.j = j;
    row.mass = mass;
    visit = {};
    visit.impulse = impulse;
    row.touches = kind == RowKind::Limit;
    visit.high = row.touches ? kUnlimited : real(0);
    return row;
}

// Which of a contact's impulses a row is of.
enum Place : std::uint8_t { Normal0, Normal1, Tangent0, Tangent1, Rolling };

// The rows of a contact: the normals of the points that the passes settle, their frictions, rolling.
JointRows directRowsOf(const Contact& c, const Motion& a, const Motion& b, const StepContext& context,
                       std::vector<std::uint8_t>& places)
{
    JointRows rows;
    rows.rowA = c.rowA;
    rows.rowB = c.rowB;
    const ContactRow<real> row = rowOf(c, a, b, context);
    const Vec2 n = row.normal, t = perpendicular(n);
    int rowOfPoint[2] = {-1, -1};
    std::uint8_t normals = 0;
    for (int k = 0; k < c.count; ++k) {
        const PointRow<real>& p = row.points[k];
        if (!(p.normalInverse > 0) || isLeftToImpacts(c, k, a, b, context)) continue;
        rowOfPoint[k] = rows.count;
        normals = static_cast<std::uint8_t>(normals | 1u << rows.count);
        places.push_back(static_cast<std::uint8_t>(Normal0 + k));
        addDirectRow(rows, RowKind::Limit, {-n, n, -p.turnA, p.turnB}, p.normalMass, p.normalImpulse);
        rows.visits[rows.count - 1].bias = p.allowed + slackOfImpact(c, c.points[k], a, b, context);
    }
    for (int k = 0; k < c.count; ++k) {
        const PointRow<real>& p = row.points[k];
        if (rowOfPoint[k] < 0 || !(row.friction > 0) || !(p.tangentInverse > 0)) continue;
        places.push_back(static_cast<std::uint8_t>(Tangent0 + k));
        ConstraintRow& friction = addDirectRow(rows, RowKind::Motor, {-t, t, -p.slideA, p.slideB},
                                               1 / p.tangentInverse, p.tangentImpulse);
        friction.pressedBy = static_cast<std::uint8_t>(1u << rowOfPoint[k]);
        friction.most = row.friction;
        rows.visits[rows.count - 1].bias = row.surfaceSpeed;
    }
    const real turn = a.invInertia + b.invInertia;
    if (normals != 0 && turn > 0 && (c.rolling > 0 || c.rollingImpulse != 0)) {
        places.push_back(Rolling);
        ConstraintRow& rolling = addDirectRow(rows, RowKind::Motor, {{}, {}, -1, 1}, turn, c.rollingImpulse);
        rolling.pressedBy = normals;
        rolling.most = c.rolling;
        rolling.angular = true;
    }
    return rows;
}

void storeDirectRows(const JointRows& rows, const std::uint8_t*& place, Contact& c)
{
    for (int i = 0; i < rows.count; ++i) {
        const real impulse = rows.visits[i].impulse;
        switch (*place++) {
        case Normal0:
        case Normal1:
            c.points[place[-1] - Normal0].normalImpulse = impulse;
            break;
        case Tangent0:
        case Tangent1:
            c.points[place[-1] - Tangent0].tangentImpulse = impulse;
            break;
        default:
            c.rollingImpulse = impulse;
        }
    }
}

// Does the contact bear a load that is heavy for one of its bodies?
bool bearsMuch(const Contact& c, const Motion& a, const Motion& b, real h)
{
    const real inverse = maximum(a.greatestInvMass(), b.greatestInvMass());
    const real forces = h * maximum(length(a.acceleration), length(b.acceleration));
    real load = 0;
    for (int k = 0; k < c.count; ++k) load += c.points[k].normalImpulse;
    return load > 0 && load * inverse > kBears * forces;
}

void aim(JointRows& joint, const JointWorld& world, const Table<LaneRow>& velocities)
{
    const auto velocityAt = [&](std::uint32_t row) { return velocityOf(velocities[row]); };
    aimJoint(world.joints, world.bodies, world.motions, velocityAt, world.context, joint);
}

}  // namespace

std::uint32_t StiffPiles::nearOf(std::uint32_t rowA, std::uint32_t rowB) const
{
    if (maximum(rowA, rowB) >= near_.islandOf.size()) return kNone;
    const std::uint32_t island = near_.islandOf[rowA];
    return island != kNone ? island : near_.islandOf[rowB];
}

bool StiffPiles::mayBeUneven(const MotionTable& motions) const
{
    const Motion *lightest = nullptr, *heaviest = nullptr;
    for (const Motion& m : motions.rows) {
        const real inverse = m.greatestInvMass();
        if (!(inverse > 0)) continue;
        if (lightest == nullptr || inverse > lightest->greatestInvMass()) lightest = &m;
        if (heaviest == nullptr || inverse < heaviest->greatestInvMass()) heaviest = &m;
    }
    return lightest != nullptr && areUneven(*lightest, *heaviest, kUnevenTies);
}

void StiffPiles::connect(const ContactTable& contacts, const MotionTable& motions, const JointSystem& joints)
{
    links_.clear();
    for (const Contact& c : contacts.rows)
        if (c.count > 0) links_.push_back({c.rowA, c.rowB});
    for (const JointTie& joint : joints.ties) {
        const std::uint32_t moving = joint.movingRow(motions.rows);
        joint.eachRow([&](std::uint32_t row) {
            if (row != moving) links_.push_back({moving, row});
        });
    }
    pushable_.assign(motions.rows.size(), false);
    for (std::size_t i = 0; i < motions.rows.size(); ++i) pushable_[i] = motions.rows[i].moves();
    linkIslands(links_, pushable_, [](std::uint32_t, std::uint32_t) { return true; }, near_);
}

void StiffPiles::findCandidates(const ContactTable& contacts, const MotionTable& motions,
                                const JointSystem& joints)
{
    const Table<Motion>& rows = motions.rows;
    touching_.assign(near_.count(), 0);
    refused_.assign(near_.count(), 0);
    candidates_.assign(near_.count(), 0);
    isLight_.assign(rows.size(), Lightness::None);
    const auto look = [&](std::uint32_t rowA, std::uint32_t rowB, Lightness as) {
        const double ratio = as == Lightness::Tied ? kUnevenTies : kUnevenTouches;
        if (!areUneven(rows[rowA], rows[rowB], ratio)) return;
        candidates_[nearOf(rowA, rowB)] = 1;
        const bool isA = rows[rowA].greatestInvMass() > rows[rowB].greatestInvMass();
        isLight_[isA ? rowA : rowB] = maximum(isLight_[isA ? rowA : rowB], as);
    };
    for (const JointTie& joint : joints.ties)
        joint.eachRow(
            [&](std::uint32_t a) { joint.eachRow([&](std::uint32_t b) { look(a, b, Lightness::Tied); }); });
    for (const Contact& c : contacts.rows) {
        if (c.count == 0) continue;
        const std::uint32_t island = nearOf(c.rowA, c.rowB);
        if (island == kNone) continue;
        touching_[island] = 1;
        look(c.rowA, c.rowB, Lightness::Touched);
        if (c.stiffSteps < 0) refused_[island] = 1;
    }
    for (std::uint32_t i = 0; i < near_.count(); ++i)
        if (near_.sizeOf[i] > kMostBodies || touching_[i] == 0 || refused_[i] != 0) candidates_[i] = 0;
    mayCrush_ = std::any_of(candidates_.begin(), candidates_.end(), [](std::uint8_t is) { return is != 0; });
}

void StiffPiles::begin(ContactTable& contacts, const MotionTable& motions, JointSystem& joints)
{
    count_ = 0;
    fallbacks_ = 0;
    candidates_.clear();
    mayCrush_ = false;
    pileOf_.clear();
    std::fill(joints.piledGroups.begin(), joints.piledGroups.end(), std::uint8_t{0});
    if (!mayBeUneven(motions)) return;
    connect(contacts, motions, joints);
    findCandidates(contacts, motions, joints);
    takeFromLanes(joints, [&](const JointTie& tie) {
        const std::uint32_t island = nearOf(tie.rowA, tie.rowB);
        return island != kNone && candidates_[island] != 0;
    });
    pileOfNear_.assign(near_.count(), kNone);
    for (const Contact& c : contacts.rows) {
        if (c.count == 0 || c.stiffSteps <= 0) continue;
        const std::uint32_t island = nearOf(c.rowA, c.rowB);
        if (island == kNone || candidates_[island] == 0 || pileOfNear_[island] != kNone) continue;
        pileOfNear_[island] = static_cast<std::uint32_t>(count_++);
    }
    if (count_ > 0) fill(0, contacts, joints);
}

std::size_t StiffPiles::add(const std::vector<std::uint32_t>& closing, ContactTable& contacts,
                            JointSystem& joints)
{
    const std::size_t before = count_;
    for (const std::uint32_t i : closing) {
        const Contact& c = contacts.rows[i];
        const std::uint32_t island = nearOf(c.rowA, c.rowB);
        if (pileOfNear_[island] == kNone) pileOfNear_[island] = static_cast<std::uint32_t>(count_++);
    }
    if (count_ > before) fill(before, contacts, joints);
    return count_ - before;
}

// Contacts and joints of the piles from `first` on.
void StiffPiles::fill(std::size_t first, ContactTable& contacts, JointSystem& joints)
{
    if (piles_.size() < count_) piles_.resize(count_);
    for (std::size_t p = first; p < count_; ++p) {
        piles_[p].contacts.clear();
        piles_[p].group.joints.clear();
        piles_[p].restless = true;
        piles_[p].failed = false;
    }
    pileOf_.resize(contacts.rows.size(), kNone);
    const auto pileAt = [&](std::uint32_t rowA, std::uint32_t rowB) {
        const std::uint32_t island = nearOf(rowA, rowB);
        const std::uint32_t pile = island == kNone ? kNone : pileOfNear_[island];
        return pile != kNone && pile >= first ? pile : kNone;
    };
    for (std::uint32_t i = 0; i < contacts.rows.size(); ++i) {
        Contact& c = contacts.rows[i];
        const std::uint32_t pile = pileAt(c.rowA, c.rowB);
        if (pile == kNone) continue;
        c.stiffSteps = maximum(c.stiffSteps, std::int8_t{1});
        pileOf_[i] = pile;
        piles_[pile].contacts.push_back(i);
    }
    for (std::uint32_t j = 0; j < joints.joints.size(); ++j) {
        JointRows& joint = joints.joints[j];
        std::uint32_t pile = kNone;
        joint.eachRow([&](std::uint32_t row) { pile = pile == kNone ? pileAt(row, row) : pile; });
        if (pile == kNone) continue;
        piles_[pile].group.joints.push_back(j);
        joints.piledGroups[joint.group] = 1;
        joint.rigidly = true;
        joints.isAltered = true;
    }
}

// The rows of a tick.
void StiffPiles::start(StiffPile& pile, const ContactTable& contacts, const JointWorld& world,
                       JointSystem& joints, Table<LaneRow>& velocities)
{
    const Table<Motion>& motions = world.motions.rows;
    pile.group.begins = true;
    pile.group.negligible = kNegligible * static_cast<double>(world.context.lengthUnit);
    pile.group.contacts.clear();
    pile.places.clear();
    pile.carried.clear();
    for (const std::uint32_t i : pile.contacts) {
        const Contact& c = contacts.rows[i];
        pile.carried.push_back({c.points[0].normalImpulse, c.points[1].normalImpulse});
        pile.group.contacts.push_back(directRowsOf(c, motionWith(motions[c.rowA], velocities[c.rowA]),
                                                   motionWith(motions[c.rowB], velocities[c.rowB]),
                                                   world.context, pile.places));
    }
    pile.group.build(joints.joints, motions);
}

// An answer that is faster than all that is known is none: pulled straight, next to nothing holds the rows of
// joints apart.
bool StiffPiles::isThrown(const StiffPile& pile, const std::vector<BodyMotion<real>>& before,
                          const JointWorld& world, const JointSystem& joints) const
{
    constexpr real kThrown = 4;  // times the fastest so far
    const Table<Motion>& motions = world.motions.rows;
    const auto speedOf = [&](const BodyMotion<real>& v, std::uint32_t row) {
        return length(v.velocity) + absolute(v.spin) * motions[row].extent;
    };
    real fastest = 0;
    for (std::size_t n = 0; n < before.size(); ++n)
        fastest = maximum(fastest, speedOf(before[n], pile.group.rows[n]));
    fastest += drivenSpeed(motions) + driveOf(joints, pile.group);
    for (std::size_t n = 0; n < own_.size(); ++n)
        if (!(speedOf(own_[n], pile.group.rows[n]) <= kThrown * fastest + world.context.lengthUnit))
            return true;
    return false;
}

real StiffPiles::visit(StiffPile& pile, ContactTable& contacts, const JointWorld& world, JointSystem& joints,
                       Table<LaneRow>& velocities)
{
    DirectGroup& group = pile.group;
    const Table<Motion>& motions = world.motions.rows;
    own_.clear();
    for (const std::uint32_t row : group.rows) own_.push_back(velocityOf(velocities[row]));
    before_ = own_;
    kept_.clear();
    for (const std::uint32_t j : group.joints) kept_.push_back(joints.joints[j]);
    const bool small = group.matrix.fill() <= kMostBlocks;
    real change = small ? solveDirect(group, joints.joints, motions, own_) : real(-1);
    if (change >= 0 && isThrown(pile, before_, world, joints)) change = -1;
    if (change >= 0) {
        for (std::size_t n = 0; n < group.rows.size(); ++n) setVelocity(velocities[group.rows[n]], own_[n]);
        const std::uint8_t* place = pile.places.data();
        for (std::size_t k = 0; k < pile.contacts.size(); ++k)
            storeDirectRows(group.contacts[k], place, contacts.rows[pile.contacts[k]]);
        return change;
    }
    return disband(pile, contacts, world, joints, velocities);
}

// No solution: what is tied and touches is visited one by one, softly, for the rest of the step, and not
// tried again for some. Returns what the first of these visits changed.
real StiffPiles::disband(StiffPile& pile, ContactTable& contacts, const JointWorld& world,
                         JointSystem& joints, Table<LaneRow>& velocities)
{
    const Table<Motion>& motions = world.motions.rows;
    const DirectGroup& group = pile.group;
    ++fallbacks_;
    pile.failed = true;
    real change = 0;
    for (std::size_t k = 0; k < group.joints.size(); ++k) {
        JointRows& joint = joints.joints[group.joints[k]];
        joint = kept_[k];
        joints.piledGroups[joint.group] = 0;
        joints.isAltered = true;
        for (std::size_t d = joints.directCount; joints.stiffGroups[joint.group] && d-- > 0;)
            if (joints.joints[joints.direct[d].joints.front()].group == joint.group) soften(joints, d);
        joint.rigidly = false;
        aim(joint, world, velocities);
        change = maximum(change, visitJoint(joint, motions, velocities));
    }
    for (const std::uint32_t i : pile.contacts) {
        Contact& c = contacts.rows[i];
        Motion a = motionWith(motions[c.rowA], velocities[c.rowA]),
               b = motionWith(motions[c.rowB], velocities[c.rowB]);
        change = maximum(change, solveContact(c, a, b, world.context));
        setVelocity(velocities[c.rowA], velocityOf(a));
        setVelocity(velocities[c.rowB], velocityOf(b));
    }
    return change;
}

bool StiffPiles::pass(std::size_t first, bool anew, ContactTable& contacts, const JointWorld& world,
                      JointSystem& joints, Table<LaneRow>& velocities, std::vector<std::uint8_t>& unrest)
{
    const real restless = world.context.tuning.restless * world.context.lengthUnit;
    bool left = false;
    for (std::size_t p = first; p < count_; ++p) {
        StiffPile& pile = piles_[p];
        if (pile.failed) continue;
        if (anew)
            start(pile, contacts, world, joints, velocities);
        else if (!pile.restless)
            continue;
        for (const std::uint32_t j : pile.group.joints) aim(joints.joints[j], world, velocities);
        const real change = visit(pile, contacts, world, joints, velocities);
        pile.restless = change > restless && (pile.failed || !pile.group.joints.empty());
        left = left || pile.restless;
        if (!pile.failed) continue;
        for (const std::uint32_t row : pile.group.rows) unrest[world.islands.islandOf[row]] = 1;
    }
    return left;
}

void StiffPiles::forgetBlows(ContactTable& contacts, const MotionTable& motions, const StepContext& context)
{
    for (std::size_t p = 0; p < count_; ++p) {
        StiffPile& pile = piles_[p];
        for (std::size_t k = 0; k < pile.carried.size(); ++k) {
            Contact& c = contacts.rows[pile.contacts[k]];
            const Motion &a = motions.rows[c.rowA], &b = motions.rows[c.rowB];
            const real inverse = maximum(a.greatestInvMass(), b.greatestInvMass());
            const real own = maximum(context.h * maximum(length(a.acceleration), length(b.acceleration)),
                                     context.tuning.restless * context.lengthUnit);
            for (int i = 0; i < c.count && inverse > 0; ++i) {
                ContactPointRow& point = c.points[i];
                const real most = 2 * (pile.carried[k][static_cast<std::size_t>(i)] + own / inverse);
                if (point.normalImpulse > most) {
                    point.tangentImpulse *= most / point.normalImpulse;
                    point.normalImpulse = most;
                }
                // Its bound was that of the normal impulse before the last.
                const real bound = c.friction * point.normalImpulse;
                point.tangentImpulse = clamp(point.tangentImpulse, -bound, bound);
            }
        }
        if (pile.failed) pile.carried.clear();
    }
}

// All overlaps at once, through whatever lies between; what joints tie stays together.
void StiffPiles::pushApart(ContactTable& contacts, const JointWorld& world, const JointSystem& joints,
                           Table<LaneRow>& pushes, ClampCounts& clamps)
{
    const Table<Motion>& motions = world.motions.rows;
    const std::vector<JointRows> none;
    for (std::size_t p = 0; p < count_; ++p) {
        StiffPile& pile = piles_[p];
        if (pile.failed) continue;
        DirectGroup& group = pile.push;
        group.contacts.clear();
        bool any = false;
        for (const std::uint32_t i : pile.contacts) {
            Contact& c = contacts.rows[i];
            const Motion &a = motions[c.rowA], &b = motions[c.rowB];
            const ContactRow<real> row = rowOf(c, a, b, world.context);
            JointRows rows;
            rows.rowA = c.rowA;
            rows.rowB = c.rowB;
            c.pushed = 0;
            for (int k = 0; k < c.count; ++k) {
                const PointRow<real>& point = row.points[k];
                if (!(point.normalInverse > 0)) continue;
                addDirectRow(rows, RowKind::Limit, {-row.normal, row.normal, -point.turnA, point.turnB},
                             point.normalMass, 0);
                real& bias = rows.visits[rows.count - 1].bias;
                bias = pushBiasOf(c.points[k].gap, c.restGap, world.context, clamps);
                any = any || bias < 0;
            }
            group.contacts.push_back(rows);
        }
        if (!any) continue;
        for (const std::uint32_t j : pile.group.joints) {
            JointRows rows = joints.joints[j];
            rows.count = rows.rigid;
            rows.turnMass = 0;
            for (int i = 0; i < rows.count; ++i) rows.visits[i] = {.low = -kUnlimited, .high = kUnlimited};
            group.contacts.push_back(rows);
        }
        std::vector<JointRows> all;
        group.build(all, motions);
        own_.assign(group.rows.size(), {});
        if (solveDirect(group, all, motions, own_) < 0) continue;
        for (std::size_t n = 0; n < group.rows.size(); ++n) setVelocity(pushes[group.rows[n]], own_[n]);
        for (std::size_t k = 0; k < pile.contacts.size(); ++k)
            for (int i = 0; i < group.contacts[k].count; ++i)
                contacts.rows[pile.contacts[k]].pushed += group.contacts[k].visits[i].impulse;
    }
}

void StiffPiles::end(ContactTable& contacts, const MotionTable& motions, const StepContext& context)
{
    if (candidates_.empty()) return;
    for (Contact& c : contacts.rows)
        if (c.stiffSteps < 0) ++c.stiffSteps;
    for (std::size_t p = 0; p < count_; ++p) {
        const std::vector<std::uint32_t>& members = piles_[p].contacts;
        const bool stays = std::any_of(members.begin(), members.end(), [&](std::uint32_t i) {
            const Contact& c = contacts.rows[i];
            return bearsMuch(c, motions.rows[c.rowA], motions.rows[c.rowB], context.h);
        });
        for (const std::uint32_t i : members) {
            std::int8_t& steps = contacts.rows[i].stiffSteps;
            if (piles_[p].failed)
                steps = -kPileSteps;
            else if (stays)
                steps = kPileSteps;
            else
                --steps;
        }
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
