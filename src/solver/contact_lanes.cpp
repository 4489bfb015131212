// SPDX-License-Identifier: MIT
// Which contact is in which lane, and the way in and out; the reckoning is that of contact_kernels.hpp.

#include "solver/contact_lanes.hpp"

#include "solver/contact_kernels.hpp"
#include "solver/flight.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

template <int W>
class ContactLanesOf final : public ContactLanes {
public:
    void build(const ContactTable& contacts, const MotionTable& motions, const Islands& islands,
               const StepContext& context) override;
    bool hasLane(std::uint32_t contact) const override
    {
        return contact < laneOf_.size() && laneOf_[contact] != kNone;
    }
    bool isInLane(std::uint32_t contact) const override
    {
        return hasLane(contact) && (blocks_[laneOf_[contact] / W].active >> (laneOf_[contact] % W) & 1u) != 0;
    }
    void load(std::uint32_t contact, const Contact& row, const MotionTable& motions,
              const TickRows& rows) override;
    void unload(std::uint32_t contact, Contact& row) override;
    void unloadAll(std::vector<Contact>& rows) override;

    void prepare(TickRows& rows, const StepContext& context, std::vector<std::uint32_t>& open) override
    {
        const std::size_t before = open.size();
        open.resize(before + W * blocks_.size());
        open.resize(before + Kernels::prepare(blocks_.data(), sources_.data(), blocks_.size(), rows, context,
                                              open.data() + before));
        solved_ = false;
    }
    void findApproaching(const TickRows& rows, const StepContext& context, real fastest,
                         std::vector<std::uint32_t>& found) const override
    {
        found.resize(W * blocks_.size());
        found.resize(Kernels::findApproaching(blocks_.data(), sources_.data(), blocks_.size(), rows, context,
                                              fastest, found.data()));
    }
    int colors() const override { return static_cast<int>(colorEnds_.size()); }
    void pass(int color, TickRows& rows, const std::uint8_t* visited, std::uint8_t* unrest,
              real restless) override
    {
        solved_ = true;
        Kernels::pass(blocks_.data() + firstOf(color), countOf(color), rows, visited, unrest, restless);
    }
    void push(int color, TickRows& rows, const StepContext& context, ClampCounts& clamps) override
    {
        clamps.push += Kernels::push(blocks_.data() + firstOf(color), sources_.data() + firstOf(color),
                                     countOf(color), rows, context);
    }
    void repay(int color, TickRows& rows, const StepContext& context) override
    {
        Kernels::repay(blocks_.data() + firstOf(color), sources_.data() + firstOf(color), countOf(color),
                       rows, context);
    }

private:
    using Kernels = ContactKernels<W>;
    using Block = ContactBlock<W>;
    using Source = ContactSource<W>;
    static constexpr std::uint32_t kNone = 0xffffffffu;

    StepContext context_;
    std::vector<std::uint32_t> laneOf_;      // by contact: block times W, plus lane
    std::vector<Block> blocks_;              // color by color
    std::vector<Source> sources_;
    std::vector<std::size_t> colorEnds_;     // in blocks
    std::vector<std::uint32_t> sorted_[3];   // contacts of a color: of two points, of one, of none yet
    bool solved_ = false;                    // have the passes of the tick begun?

    std::size_t firstOf(int color) const
    {
        return color == 0 ? 0 : colorEnds_[static_cast<std::size_t>(color) - 1];
    }
    std::size_t countOf(int color) const
    {
        return colorEnds_[static_cast<std::size_t>(color)] - firstOf(color);
    }
    void place(std::uint32_t contact, const Contact& row, std::size_t slot, const MotionTable& motions,
               const Islands& islands);
};

// Two points first, so that blocks of one point need not look for a second.
template <int W>
void ContactLanesOf<W>::build(const ContactTable& contacts, const MotionTable& motions,
                              const Islands& islands, const StepContext& context)
{
    context_ = context;
    laneOf_.assign(contacts.rows.size(), std::uint32_t{kNone});
    blocks_.clear();
    sources_.clear();
    colorEnds_.clear();
    solved_ = false;
    std::size_t at = 0;
    // The last color is visited in order, and what is found in mid-step has no lane either.
    for (std::size_t color = 0; color + 1 < contacts.colorEnds.size(); ++color) {
        for (auto& list : sorted_) list.clear();
        for (; at < contacts.colorEnds[color]; ++at) {
            const std::uint32_t i = contacts.order[at];
            const Contact& c = contacts.rows[i];
            if (c.rolling > 0 || (c.count == 0 && !c.swept)) continue;
            sorted_[2 - c.count].push_back(i);
        }
        std::size_t slot = blocks_.size() * W;
        const std::size_t count = sorted_[0].size() + sorted_[1].size() + sorted_[2].size();
        if (count == 0 && at == contacts.order.size()) break;
        blocks_.resize(blocks_.size() + (count + W - 1) / W);
        sources_.resize(blocks_.size());
        for (const auto& list : sorted_)
            for (const std::uint32_t i : list) place(i, contacts.rows[i], slot++, motions, islands);
        colorEnds_.push_back(blocks_.size());
    }
}

template <int W>
void ContactLanesOf<W>::place(std::uint32_t contact, const Contact& row, std::size_t slot,
                              const MotionTable& motions, const Islands& islands)
{
    Block& b = blocks_[slot / W];
    const auto lane = static_cast<int>(slot % W);
    const std::uint32_t bit = 1u << lane;
    laneOf_[contact] = static_cast<std::uint32_t>(slot);
    sources_[slot / W].contact[lane] = contact;
    b.rowA[lane] = row.rowA;
    b.rowB[lane] = row.rowB;
    b.island[lane] = islandOf(islands, row.rowA, row.rowB);
    b.oneIsland = b.oneIsland && b.island[lane] == b.island[0];
    if (motions.rows[row.rowA].moves()) b.movesA |= bit;
    if (motions.rows[row.rowB].moves()) b.movesB |= bit;
}

template <int W>
void ContactLanesOf<W>::load(std::uint32_t contact, const Contact& c, const MotionTable& motions,
                             const TickRows& rows)
{
    const std::uint32_t slot = laneOf_[contact];
    const auto lane = static_cast<int>(slot % W);
    const std::uint32_t bit = 1u << lane;
    Block& b = blocks_[slot / W];
    Source& s = sources_[slot / W];
    const auto set = [bit](std::uint32_t& bits, bool on) { bits = on ? bits | bit : bits & ~bit; };
    set(b.active, true);
    set(b.two, c.count == 2);
    set(s.elastic, c.restitution > 0);
    set(s.atImpact, c.atImpact);

    const Motion &mA = motions.rows[c.rowA], &mB = motions.rows[c.rowB];
    setLane(b.row.normal, lane, c.normal);
    setLane(b.row.invMassA, lane, mA.invMass);
    setLane(b.row.invMassB, lane, mB.invMass);
    b.row.invInertiaA.v[lane] = mA.invInertia;
    b.row.invInertiaB.v[lane] = mB.invInertia;
    b.row.friction.v[lane] = c.friction;
    b.row.surfaceSpeed.v[lane] = c.surfaceSpeed;
    b.row.blockInverse.v[lane] = 0;
    s.slowest.v[lane] = slowestInCrowd(c, context_);
    setLane(s.start, lane, toVec2(rows.origins[c.rowB] - rows.origins[c.rowA]));
    s.restGap.v[lane] = c.restGap;
    s.radiusA.v[lane] = c.radiusA;
    s.radiusB.v[lane] = c.radiusB;
    s.turns.v[lane] = c.count == 1 && normalTurns(c, c.points[0].anchor) ? -1 : 0;
    s.counted.v[lane] = 0;
    setLane(s.stepImpulse, lane, c.stepImpulse);
    for (int k = 0; k < 2; ++k) {
        const ContactPointRow& p = c.points[k];
        const bool present = k < c.count;
        s.present[k].v[lane] = present ? -1 : 0;
        s.cornerOnA[k].v[lane] = p.anchor.cornerOnA ? -1 : 0;
        setLane(s.localA[k], lane, present ? p.anchor.localA : Vec2{});
        setLane(s.localB[k], lane, present ? p.anchor.localB : Vec2{});
        b.row.points[k].normalImpulse.v[lane] = present ? p.normalImpulse : real(0);
        b.row.points[k].tangentImpulse.v[lane] = present ? p.tangentImpulse : real(0);
        s.stepNormal[k].v[lane] = p.stepNormal;
        s.stepTangent[k].v[lane] = p.stepTangent;
    }
}

template <int W>
void ContactLanesOf<W>::unload(std::uint32_t contact, Contact& c)
{
    const std::uint32_t slot = laneOf_[contact];
    const auto lane = static_cast<int>(slot % W);
    Block& b = blocks_[slot / W];
    Source& s = sources_[slot / W];
    b.active &= ~(1u << lane);
    c.normal = laneOf(b.row.normal, lane);
    c.stepImpulse = laneOf(s.stepImpulse, lane);
    const bool add = solved_ && s.counted.v[lane] != 0;
    for (int k = 0; k < c.count; ++k) {
        ContactPointRow& p = c.points[k];
        p.normalImpulse = b.row.points[k].normalImpulse.v[lane];
        p.tangentImpulse = b.row.points[k].tangentImpulse.v[lane];
        p.stepNormal = s.stepNormal[k].v[lane] + (add ? p.normalImpulse : real(0));
        p.stepTangent = s.stepTangent[k].v[lane] + (add ? p.tangentImpulse : real(0));
        if (add) c.stepImpulse += p.normalImpulse * c.normal + p.tangentImpulse * perpendicular(c.normal);
        // What moves nothing any more.
        b.row.points[k].normalInverse.v[lane] = b.row.points[k].tangentInverse.v[lane] = 0;
        b.row.points[k].normalImpulse.v[lane] = b.row.points[k].tangentImpulse.v[lane] = 0;
        s.present[k].v[lane] = 0;
    }
    b.row.blockInverse.v[lane] = 0;
}

template <int W>
void ContactLanesOf<W>::unloadAll(std::vector<Contact>& rows)
{
    for (std::size_t k = 0; k < blocks_.size(); ++k)
        for (int lane = 0; lane < W; ++lane)
            if ((blocks_[k].active >> lane & 1u) != 0)
                unload(sources_[k].contact[lane], rows[sources_[k].contact[lane]]);
}

}  // namespace

bool isPlain(const Contact& c)
{
    if (c.count == 0 || c.impacts > 0 || c.rolling > 0 || c.rollingImpulse != 0) return false;
    if (!(c.restitution > 0)) return true;
    for (int i = 0; i < c.count; ++i)
        if (!(c.points[i].normalImpulse > 0)) return false;
    return true;
}

std::unique_ptr<ContactLanes> makeContactLanes(LaneWidth width)
{
    switch (width == LaneWidth::Best ? bestLanes() : width) {
    case LaneWidth::Bytes64:
        return std::make_unique<ContactLanesOf<kLanes64>>();
    case LaneWidth::Bytes32:
        return std::make_unique<ContactLanesOf<kLanes32>>();
    case LaneWidth::Scalar:
        return std::make_unique<ContactLanesOf<1>>();
    case LaneWidth::Bytes16:
    case LaneWidth::Best:
        break;
    }
    return std::make_unique<ContactLanesOf<kLanes16>>();
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
