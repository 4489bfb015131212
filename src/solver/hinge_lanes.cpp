// SPDX-License-Identifier: MIT
// Which hinge is in which lane, and the way in and out; the reckoning is that of hinge_kernels.hpp.

#include "solver/hinge_lanes.hpp"

#include "joints/softness.hpp"
#include "solver/contact_block.hpp"
#include "solver/contact_lanes.hpp"
#include "solver/hinge_kernels.hpp"
#include "solver/with_lanes.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

template <int W>
void setDouble(DoubleLane<W>& wide, int lane, double value)
{
    if constexpr (W == 1)
        wide.v = value;
    else
        wide.v[lane / DoubleLane<W>::kWidth][lane % DoubleLane<W>::kWidth] = value;
}
template <int W>
double doubleOf(const DoubleLane<W>& wide, int lane)
{
    if constexpr (W == 1)
        return wide.v;
    else
        return wide.v[lane / DoubleLane<W>::kWidth][lane % DoubleLane<W>::kWidth];
}

template <int W>
class HingeLanesOf final : public HingeLanes {
public:
    explicit HingeLanesOf(Parallel& parallel) : parallel_(parallel) {}

    void build(const JointSystem& system, const JointTable& joints, const BodyTable& bodies,
               const MotionTable& motions, const Islands& islands, const TickRows& rows) override;
    void storeAll(JointTable& joints) override;
    bool empty() const override { return blocks_.empty(); }

    void addPull(std::vector<real>& pull) const override
    {
        Kernels::addPull(blocks_.data(), sources_.data(), blocks_.size(), pull.data());
    }
    void addSteady(Table<Motion>& motions) override
    {
        eachOfColors([&](std::size_t first, std::size_t count) {
            Kernels::addSteady(blocks_.data() + first, sources_.data() + first, count, motions.data());
        });
    }
    void start(Table<Motion>& motions, TickRows& rows, const std::vector<std::uint8_t>& wholeGroups,
               const StepContext& context) override
    {
        findTurns(motions, rows, context);
        each([&](std::size_t first, std::size_t count) {
            Kernels::start(blocks_.data() + first, sources_.data() + first, count, motions.data(),
                           turns_.data(), wholeGroups.data(), context);
        });
    }
    void pass(Table<Motion>& motions, TickRows& rows, const std::uint8_t* visited, std::uint8_t* unrest,
              real restless, const StepContext& context) override
    {
        if (visited != nullptr) findTurns(motions, rows, context);
        passOver({velocitiesOf(rows), visited != nullptr ? turns_.data() : nullptr, visited, unrest, false,
                  true, restless});
    }
    void findLost(Table<Motion>& motions, TickRows& rows, std::vector<std::uint8_t>& lost, real trusted,
                  const StepContext& context) override
    {
        findTurns(motions, rows, context);
        each([&](std::size_t first, std::size_t count) {
            Kernels::findLost(blocks_.data() + first, count, turns_.data(), trusted, lost.data());
        });
    }
    void flatten(const std::vector<std::uint8_t>& lost, TickRows& rows, const StepContext& context) override
    {
        const HingePass with{velocitiesOf(rows), nullptr, nullptr, nullptr, false, true, 0};
        eachOfColors([&](std::size_t first, std::size_t count) {
            Kernels::flatten(blocks_.data() + first, sources_.data() + first, count, lost.data(), with,
                             context);
        });
    }
    void tally(const Table<Motion>& motions) override
    {
        each([&](std::size_t first, std::size_t count) {
            Kernels::tally(blocks_.data() + first, sources_.data() + first, count, motions.data());
        });
    }
    void measure(const Table<Motion>& motions, const TickRows& rows) override
    {
        each([&](std::size_t first, std::size_t count) {
            Kernels::measure(blocks_.data() + first, sources_.data() + first, count, motions.data(), rows);
        });
    }
    void settle(Table<Motion>& motions, const StepContext& context) override
    {
        eachOfColors([&](std::size_t first, std::size_t count) {
            Kernels::settle(blocks_.data() + first, sources_.data() + first, count, motions.data(), context);
        });
    }
    void settlingPass(Table<Motion>& motions, const std::uint8_t* visited, std::uint8_t* unrest,
                      real restless) override
    {
        auto* const first = reinterpret_cast<std::byte*>(motions.data()) + offsetof(Motion, velocity);
        passOver({{first, sizeof(Motion)}, nullptr, visited, unrest, true, false, restless});
    }
    void keep(const std::vector<std::uint8_t>& hit, const StepContext& context) override
    {
        each([&](std::size_t first, std::size_t count) {
            Kernels::keep(blocks_.data() + first, sources_.data() + first, count, hit.data(), context);
        });
    }

private:
    using Kernels = HingeKernels<W>;
    using Block = HingeBlock<W>;
    using Source = HingeSource<W>;
    static constexpr std::size_t kGrain = 256 / W;   // blocks that are worth a thread's while

    Parallel& parallel_;
    Table<Block> blocks_;                     // color by color
    Table<Source> sources_;
    Table<LaneRow> turns_;                    // by row
    std::vector<std::size_t> colorEnds_;      // in blocks
    std::vector<std::uint64_t> colorsAt_;     // by row: taken by its hinges, as bits
    std::vector<std::uint8_t> colorOf_;       // by hinge
    std::vector<std::size_t> places_;         // by color: the next free lane

    static VelocityRows velocitiesOf(TickRows& rows)
    {
        return {reinterpret_cast<std::byte*>(rows.velocities.data()), sizeof(LaneRow)};
    }
    template <class Body>
    void each(Body body)
    {
        parallel_.forEach(blocks_.size(), kGrain,
                          [&](const Chunk& chunk) { body(chunk.begin, chunk.end - chunk.begin); });
    }
    // Those of one color may be side by side.
    template <class Body>
    void eachOfColors(Body body)
    {
        std::size_t first = 0;
        for (const std::size_t end : colorEnds_) {
            parallel_.forEach(end - first, kGrain, [&](const Chunk& chunk) {
                body(first + chunk.begin, chunk.end - chunk.begin);
            });
            first = end;
        }
    }
    void passOver(const HingePass& with)
    {
        eachOfColors([&](std::size_t first, std::size_t count) {
            Kernels::pass(blocks_.data() + first, count, with);
        });
    }
    void findTurns(Table<Motion>& motions, TickRows& rows, const StepContext& context)
    {
        turns_.resize(motions.size());
        parallel_.forEach(motions.size(), kBodyGrain, [&](const Chunk& chunk) {
            Kernels::turns(bodiesOf(chunk, motions, rows), turns_.data(), context);
        });
    }
    void color(const JointSystem& system, const MotionTable& motions);
    void place(const JointTie& tie, std::size_t slot, const JointRow& joint, const BodyTable& bodies,
               const MotionTable& motions, const Islands& islands, const TickRows& rows);
};

// Each gets the first color that none of its bodies has yet; they have fewer hinges than there are colors.
template <int W>
void HingeLanesOf<W>::color(const JointSystem& system, const MotionTable& motions)
{
    colorsAt_.assign(motions.rows.size(), 0);
    colorOf_.clear();
    places_.clear();
    for (const JointTie& tie : system.hinges) {
        const bool onA = motions.rows[tie.rowA].moves(), onB = motions.rows[tie.rowB].moves();
        const std::uint64_t taken = (onA ? colorsAt_[tie.rowA] : 0) | (onB ? colorsAt_[tie.rowB] : 0);
        const int color = std::countr_one(taken);
        if (onA) colorsAt_[tie.rowA] |= std::uint64_t{1} << color;
        if (onB) colorsAt_[tie.rowB] |= std::uint64_t{1} << color;
        colorOf_.push_back(static_cast<std::uint8_t>(color));
        if (places_.size() <= static_cast<std::size_t>(color))
            places_.resize(static_cast<std::size_t>(color) + 1);
        ++places_[static_cast<std::size_t>(color)];
    }
    colorEnds_.clear();
    std::size_t end = 0;
    for (std::size_t& count : places_) {
        const std::size_t first = end * W;
        end += (count + W - 1) / W;
        colorEnds_.push_back(end);
        count = first;
    }
}

template <int W>
void HingeLanesOf<W>::build(const JointSystem& system, const JointTable& joints, const BodyTable& bodies,
                            const MotionTable& motions, const Islands& islands, const TickRows& rows)
{
    color(system, motions);
    const std::size_t count = colorEnds_.empty() ? 0 : colorEnds_.back();
    blocks_.assign(count, {});
    sources_.assign(count, {});
    for (std::size_t k = 0; k < system.hinges.size(); ++k) {
        const JointTie& tie = system.hinges[k];
        place(tie, places_[colorOf_[k]]++, joints.rows[tie.joint], bodies, motions, islands, rows);
    }
    // An empty lane reads what its neighbor reads, and no row that another thread may be writing.
    for (Block& block : blocks_)
        for (int lane = 0; lane < W; ++lane) {
            if ((block.active >> lane & 1u) != 0) continue;
            block.rowA[lane] = block.rowA[0];
            block.rowB[lane] = block.rowB[0];
            block.group[lane] = block.group[0];
            block.island[lane] = block.island[0];
        }
    measure(motions.rows, rows);
}

template <int W>
void HingeLanesOf<W>::place(const JointTie& tie, std::size_t slot, const JointRow& joint,
                            const BodyTable& bodies, const MotionTable& motions, const Islands& islands,
                            const TickRows& rows)
{
    Block& block = blocks_[slot / W];
    Source& source = sources_[slot / W];
    const auto lane = static_cast<int>(slot % W);
    const std::uint32_t bit = 1u << lane;
    const auto& hinge = std::get<RevoluteJoint>(joint.def.kind);
    const Motion &a = motions.rows[tie.rowA], &b = motions.rows[tie.rowB];
    const BodyRow &bodyA = bodies.rows[joint.bodyA], &bodyB = bodies.rows[joint.bodyB];

    block.rowA[lane] = tie.rowA;
    block.rowB[lane] = tie.rowB;
    block.group[lane] = tie.group;
    block.island[lane] = islandOf(islands, tie.rowA, tie.rowB);
    block.active |= bit;
    if (a.moves()) block.movesA |= bit;
    if (b.moves()) block.movesB |= bit;
    block.turns = block.turns || hinge.spring || hinge.motor || hinge.limits;

    source.joint[lane] = tie.joint;
    if (a.isDamped() || b.isDamped()) source.damped |= bit;
    setLane(source.localA, lane, hinge.anchorA - bodyA.localCenter);
    setLane(source.localB, lane, hinge.anchorB - bodyB.localCenter);
    setLane(source.start, lane, toVec2(rows.origins[tie.rowB].center - rows.origins[tie.rowA].center));
    source.strained[lane] = joint.strainedTicks;
    source.work[lane] = joint.stepWork;
    setDouble(source.angle, lane, joint.angle);
    if (hinge.spring) {
        const real inverse = bodyA.invInertia() + bodyB.invInertia();
        const real inertia = inverse > 0 ? 1 / inverse : real(0);
        const real turn = static_cast<real>(kTwoPi) * hinge.spring->frequency;
        source.springs |= bit;
        source.stiffness.v[lane] = inertia * turn * turn;
        source.damping.v[lane] = 2 * hinge.spring->dampingRatio * inertia * turn;
        setDouble(source.zero, lane, hinge.referenceAngle + static_cast<double>(hinge.spring->rest));
    }
    if (hinge.motor) {
        source.motors |= bit;
        source.speed.v[lane] = hinge.motor->speed;
        source.strength.v[lane] = hinge.motor->maxForce;
    }
    const auto limit = [&](int side, real at, bool has) {
        if (!has) return;
        source.limited[side] |= bit;
        setDouble(source.rest[side], lane, hinge.referenceAngle + static_cast<double>(at));
        if (joint.held[side]) source.held[side] |= bit;
    };
    if (hinge.limits) {
        limit(0, hinge.limits->lower, hinge.limits->lower > -kUnlimited);
        limit(1, hinge.limits->upper, hinge.limits->upper < kUnlimited);
    }
    const auto take = [&](HingeImpulses<Lane<W>>& to, const real* from) {
        setLane(to.point, lane, {from[JointSlot::kBlock], from[JointSlot::kBlock + 1]});
        to.spring.v[lane] = from[JointSlot::kSpring];
        to.motor.v[lane] = from[JointSlot::kMotor];
        to.limits[0].v[lane] = from[JointSlot::kLower];
        to.limits[1].v[lane] = from[JointSlot::kUpper];
    };
    take(source.carried, joint.impulses);
    take(source.sums, joint.stepSums);
}

template <int W>
void HingeLanesOf<W>::storeAll(JointTable& joints)
{
    each([&](std::size_t first, std::size_t count) {
        for (std::size_t slot = first * W; slot < (first + count) * W; ++slot) {
            const Block& block = blocks_[slot / W];
            const Source& source = sources_[slot / W];
            const auto lane = static_cast<int>(slot % W);
            if ((block.active >> lane & 1u) == 0) continue;
            JointRow& joint = joints.rows[source.joint[lane]];
            const auto give = [&](const HingeImpulses<Lane<W>>& from, real* to) {
                to[JointSlot::kBlock] = from.point.x.v[lane];
                to[JointSlot::kBlock + 1] = from.point.y.v[lane];
                to[JointSlot::kSpring] = from.spring.v[lane];
                to[JointSlot::kMotor] = from.motor.v[lane];
                to[JointSlot::kLower] = from.limits[0].v[lane];
                to[JointSlot::kUpper] = from.limits[1].v[lane];
            };
            joint.forgetLoads();
            give(source.carried, joint.impulses);
            give(source.sums, joint.stepSums);
            const real* const sums = joint.stepSums;
            joint.stepImpulse = {sums[JointSlot::kBlock], sums[JointSlot::kBlock + 1]};
            joint.stepTurn = sums[JointSlot::kSpring] + sums[JointSlot::kMotor] + sums[JointSlot::kLower] -
                             sums[JointSlot::kUpper];
            joint.stepWork = source.work[lane];
            joint.angle = doubleOf(source.angle, lane);
            joint.strainedTicks = source.strained[lane];
            for (const int side : {0, 1}) joint.held[side] = (source.held[side] >> lane & 1u) != 0;
            if ((source.stiffened >> lane & 1u) != 0) joint.stiffSteps = kHold;
        }
    });
    blocks_.clear();
    sources_.clear();
    colorEnds_.clear();
}

}  // namespace

std::unique_ptr<HingeLanes> makeHingeLanes(LaneWidth width, Parallel& parallel)
{
    return withLanes(width, [&](auto lanes) -> std::unique_ptr<HingeLanes> {
        return std::make_unique<HingeLanesOf<lanes()>>(parallel);
    });
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
