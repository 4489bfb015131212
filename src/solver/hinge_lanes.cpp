// SPDX-License-Identifier: MIT
// Which hinge is in which lane, and the way in and out; the reckoning is that of hinge_kernels.hpp.

#include "solver/hinge_lanes.hpp"

#include "joints/softness.hpp"
#include "math/with_lanes.hpp"
#include "solver/contact_lanes.hpp"
#include "solver/hinge_kernels.hpp"
#include "solver/hinge_slots.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

template <int W>
class HingeLanesOf final : public HingeLanes {
public:
    explicit HingeLanesOf(Parallel& parallel) : parallel_(parallel) {}

    void take(const JointSystem& system, const JointTable& joints, const BodyTable& bodies,
              const MotionTable& motions, const Islands& islands, const TickRows& rows) override
    {
        if (listing_ == system.listing)
            carryOn(islands, rows);
        else
            build(system, joints, bodies, motions, islands, rows);
        listing_ = system.listing;
        prepared_ = false;
        each([&](const Run& run, std::size_t) { Kernels::measure(run, motions.rows.data(), rows); });
    }
    void store(const JointSystem& system, JointTable& joints) override;
    void clear() override
    {
        blocks_.clear();
        sources_.clear();
        angles_.clear();
        colorEnds_.clear();
        listing_ = JointSystem::kNeverListed;
    }
    bool empty() const override { return blocks_.empty(); }

    void addPull(std::vector<real>& pull) override
    {
        Kernels::addPull(runOf(0, blocks_.size()), pull.data());
    }
    void addSteady(const Table<Motion>& motions, TickRows& rows, bool inertiasAreSame) override
    {
        prepared_ = prepared_ && inertiasAreSame;
        eachOfColors(
            [&](const Run& run) { Kernels::addSteady(run, motions.data(), prepared_, rows.steady.data()); });
        prepared_ = true;
    }
    void firstPass(Table<Motion>& motions, TickRows& rows, const std::vector<std::uint8_t>& wholeGroups,
                   std::uint8_t* unrest, real restless, const StepContext& context) override
    {
        findTurns(motions, rows, context);
        const HingeStart start{motions.data(), turns_.data(), wholeGroups.data(), prepared_};
        const HingePass with{rows.velocities.data(), turns_.data(), nullptr, unrest, restless};
        eachOfColors([&](const Run& run) { Kernels::firstPass(run, start, with, context); });
    }
    void pass(Table<Motion>& motions, TickRows& rows, const std::uint8_t* visited, std::uint8_t* unrest,
              real restless, const StepContext& context) override
    {
        findTurns(motions, rows, context);
        const HingePass with{rows.velocities.data(), turns_.data(), visited, unrest, restless};
        eachOfColors([&](const Run& run) { Kernels::pass(run, with); });
    }
    void findLost(Table<Motion>& motions, TickRows& rows, std::vector<std::uint8_t>& lost, real trusted,
                  const StepContext& context) override
    {
        findTurns(motions, rows, context);
        each([&](const Run& run, std::size_t) {
            Kernels::findLost(run, turns_.data(), trusted, lost.data());
        });
    }
    void flatten(const std::vector<std::uint8_t>& lost, TickRows& rows, const StepContext& context) override
    {
        eachOfColors(
            [&](const Run& run) { Kernels::flatten(run, lost.data(), rows.velocities.data(), context); });
    }
    void settle(const Table<Motion>& motions, TickRows& rows, const StepContext& context) override
    {
        eachOfColors(
            [&](const Run& run) { Kernels::settle(run, motions.data(), rows, rows.turned.data(), context); });
        prepared_ = true;
    }
    void settlingPass(TickRows& rows, const std::uint8_t* visited, std::uint32_t* changed,
                      real restless) override
    {
        eachOfColors([&](const Run& run) {
            Kernels::settlingPass(run, rows.velocities.data(), visited, changed, restless);
        });
    }
    void keep(const std::uint8_t* hit, const TickRows& rows, const StepContext& context) override
    {
        each([&](const Run& run, std::size_t) { Kernels::keep(run, hit, rows.velocities.data(), context); });
    }

private:
    using Kernels = HingeKernels<W>;
    using Block = HingeBlock<W>;
    using Source = HingeSource<W>;
    using Angle = HingeAngle<W>;
    using Run = HingeRun<W>;
    static constexpr std::size_t kGrain = 256 / W;   // blocks that are worth a thread's while

    Parallel& parallel_;
    Table<Block> blocks_;                     // color by color
    Table<Source> sources_;                   // by block
    Table<Angle> angles_;                     // of those that have one
    std::uint64_t listing_ = JointSystem::kNeverListed;   // of which they are
    bool prepared_ = false;                   // have they the effective masses of now?
    Table<LaneRow> turns_;                    // by row
    std::vector<std::size_t> colorEnds_;      // in blocks
    std::vector<std::uint64_t> colorsAt_;     // by row: taken by its hinges, as bits
    std::vector<std::uint8_t> colorOf_;       // by hinge
    std::vector<std::size_t> places_;         // by color: the next free lane
    std::vector<std::size_t> slots_;          // by hinge: its lane
    std::vector<std::uint8_t> stiffens_;      // by chunk

    Run runOf(std::size_t first, std::size_t count)
    {
        return {blocks_.data() + first, sources_.data() + first, angles_.data(), count};
    }
    template <class Body>
    void each(Body body)
    {
        parallel_.forEach(blocks_.size(), kGrain, [&](const Chunk& chunk) {
            body(runOf(chunk.begin, chunk.end - chunk.begin), chunk.index);
        });
    }
    // Those of one color may be side by side.
    template <class Body>
    void eachOfColors(Body body)
    {
        std::size_t first = 0;
        for (const std::size_t end : colorEnds_) {
            parallel_.forEach(end - first, kGrain, [&](const Chunk& chunk) {
                body(runOf(first + chunk.begin, chunk.end - chunk.begin));
            });
            first = end;
        }
    }
    void findTurns(Table<Motion>& motions, TickRows& rows, const StepContext& context)
    {
        turns_.resize(motions.size());
        parallel_.forEach(motions.size(), kBodyGrain, [&](const Chunk& chunk) {
            Kernels::turns(bodiesOf(chunk, motions, rows), turns_.data(), context);
        });
    }
    void build(const JointSystem& system, const JointTable& joints, const BodyTable& bodies,
               const MotionTable& motions, const Islands& islands, const TickRows& rows);
    void carryOn(const Islands& islands, const TickRows& rows);
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
    const auto turns = [&](std::uint32_t joint) {
        const auto& hinge = std::get<RevoluteJoint>(joints.rows[joint].def.kind);
        return hinge.spring || hinge.motor || hinge.limits;
    };
    slots_.clear();
    for (std::size_t k = 0; k < system.hinges.size(); ++k) {
        slots_.push_back(places_[colorOf_[k]]++);
        if (turns(system.hinges[k].joint)) blocks_[slots_.back() / W].angle = 0;
    }
    std::uint32_t angles = 0;
    for (Block& block : blocks_)
        if (block.turns()) block.angle = angles++;
    angles_.assign(angles, {});
    for (std::size_t k = 0; k < system.hinges.size(); ++k) {
        const JointTie& tie = system.hinges[k];
        place(tie, slots_[k], joints.rows[tie.joint], bodies, motions, islands, rows);
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
}

// The next step, with the same bodies and joints.
template <int W>
void HingeLanesOf<W>::carryOn(const Islands& islands, const TickRows& rows)
{
    each([&](const Run& run, std::size_t) {
        for (std::size_t k = 0; k < run.count; ++k) {
            Block& block = run.blocks[k];
            Source& source = run.sources[k];
            source.sums = {};
            source.stiffened = 0;
            block.oneIsland = true;
            for (int lane = 0; lane < W; ++lane) {
                const std::uint32_t a = block.rowA[lane], b = block.rowB[lane];
                block.island[lane] = islandOf(islands, a, b);
                block.oneIsland = block.oneIsland && block.island[lane] == block.island[0];
                if ((block.active >> lane & 1u) != 0) setLane(source.start, lane, startBetween(rows, a, b));
            }
            if (Angle* const angle = run.angleOf(block)) {
                angle->sums = {};
                for (double& work : angle->work) work = 0;
            }
        }
    });
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
    block.oneGroup = block.oneGroup && block.group[lane] == block.group[0];
    block.oneIsland = block.oneIsland && block.island[lane] == block.island[0];
    block.active |= bit;
    if (a.moves()) block.movesA |= bit;
    if (b.moves()) block.movesB |= bit;

    source.joint[lane] = tie.joint;
    if (a.isDamped() || b.isDamped()) source.damped |= bit;
    setLane(source.localA, lane, hinge.anchorA - bodyA.localCenter);
    setLane(source.localB, lane, hinge.anchorB - bodyB.localCenter);
    setLane(source.start, lane, startBetween(rows, tie.rowA, tie.rowB));
    source.strained[lane] = joint.strainedTicks;
    source.anyStrained = source.anyStrained || joint.strainedTicks != 0;
    setDouble(source.angle, lane, joint.angle);
    readImpulses(joint.impulses, lane, source.carried);
    readImpulses(joint.stepSums, lane, source.sums);
    if (block.turns()) placeAngle(angles_[block.angle], lane, joint, bodyA.invInertia() + bodyB.invInertia());
}

template <int W>
void HingeLanesOf<W>::store(const JointSystem& system, JointTable& joints)
{
    stiffens_.assign(Parallel::chunksOf(blocks_.size(), kGrain), 0);
    each([&](const Run& run, std::size_t chunk) {
        for (std::size_t slot = 0; slot < run.count * W; ++slot) {
            const Block& block = run.blocks[slot / W];
            const Source& source = run.sources[slot / W];
            const auto lane = static_cast<int>(slot % W);
            if ((block.active >> lane & 1u) == 0) continue;
            JointRow& joint = joints.rows[source.joint[lane]];
            storeHinge(source, run.angleOf(block), lane, joint);
            if ((source.stiffened >> lane & 1u) == 0 || joint.stiffSteps < 0) continue;
            joint.stiffSteps = kHold;
            if (hasStiffSize(system, block.group[lane])) stiffens_[chunk] = 1;
        }
    });
    if (std::find(stiffens_.begin(), stiffens_.end(), std::uint8_t{1}) != stiffens_.end()) ++joints.changes;
}

}  // namespace

std::unique_ptr<HingeLanes> makeHingeLanes(LaneWidth width, Parallel& parallel)
{
    return withLanes(width, [&](auto lanes) -> std::unique_ptr<HingeLanes> {
        return std::make_unique<HingeLanesOf<lanes()>>(parallel);
    });
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
