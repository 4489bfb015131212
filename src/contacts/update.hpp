// SPDX-License-Identifier: MIT
#pragma once

#include "base/lane_choice.hpp"
#include "contacts/pairs.hpp"
#include "model/contacts.hpp"
#include "model/motion.hpp"
#include "model/shapes.hpp"
#include "model/step_context.hpp"
#include "narrowphase/side_by_side.hpp"
#include "tasks/parallel.hpp"

#include <tamias2d/model/clamps.hpp>

#include <span>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The acceleration a body is expected to have: forces, damping and steady contacts.   [m/s^2]
Vec2 expectedAcceleration(const Motion& m, real invH);
real expectedSpinRate(const Motion& m, real invH);   ///< [rad/s^2]

/// The way of a body that nothing hits, seen from `origin`.
Trajectory predictedPath(const Motion& m, Position origin, real invH);

/// The place a pair is seen from: the center of the smaller body, where `real` resolves best.
Position originOf(const Motion& a, const Motion& b);

/// Both ways of a pair, seen from there.
SweptPair sweptPairOf(const Contact& contact, const ShapeTable& shapes, const Motion& a, const Motion& b,
                      real invH);

/// The box of a shape that holds still, as the broad phase has it: with the room that those of moving shapes
/// have.
Aabb restingBounds(const BodyRow& body, const Convex& shape, real restGap);
inline Aabb restingBounds(const ContactWorld& world, std::uint32_t shape)
{
    return restingBounds(world.bodies.rows[world.shapes.rows[shape].body], world.shapes.convex(shape),
                         world.restGap);
}

inline constexpr std::size_t kPairBatch = 64;

/// The ways of bodies within one span of time, from 0 on: each is reckoned once for all pairs of its body,
/// before anything is asked of those.
class ExpectedPaths {
public:
    /// Pairs are looked at in lanes of the width that a world asks for.
    explicit ExpectedPaths(LaneWidth asked) : asked_(askedLanes(asked)) {}

    /// Forgets all; from here on paths are those until `end`.
    void begin(std::size_t rows, real end, real invH);
    /// Makes room for rows that have come in.
    void grow(std::size_t rows) { rows_.resize(rows); }
    /// Reckons the way of a body, seen from its center; with its turn up to the end unless it is only asked
    /// for discs. Rows may be reckoned side by side.
    const Trajectory& reckon(std::size_t row, const Motion& m, bool turns);
    /// Tells that the pair of a contact will be asked for.
    void want(const Contact& contact, const ShapeTable& shapes);
    /// Has it one already?
    bool isReckoned(std::size_t row) const { return rows_[row].number == number_; }
    /// Reckons the ways of all that are wanted and have none yet.
    void reckonWanted(const MotionTable& motions, Parallel& parallel);
    std::size_t bytes() const
    {
        return rows_.capacity() * sizeof(Row) + wanted_.capacity() * sizeof(std::uint32_t);
    }

    /// The way of a body that has one, seen from its center.
    const Trajectory& wayOf(std::uint32_t row) const { return rows_[row].path; }
    /// Both ways of a pair, as sweptPairOf.
    SweptPair pairOf(const Contact& contact, const ShapeTable& shapes, const MotionTable& motions) const;
    /// The same as lanes take it.
    PairOnWay pairOnWayOf(const Contact& contact, const ShapeTable& shapes, const MotionTable& motions) const;

    /// How the pairs of up to kPairBatch contacts meet within the span: as collideSwept says of each, in
    /// lanes where those can decide.
    void collide(std::span<Contact* const> contacts, const ShapeTable& shapes, const MotionTable& motions,
                 SweptResult* results) const;

private:
    struct Row {
        SpanOfWay span;
        Trajectory path;  // but for its position
        std::uint64_t number = 0;  // of the span of time that it is wanted for
        bool turns = false;
    };
    LaneWidth asked_;
    const PairKernels* kernels_ = nullptr;  // of the width that suits the rows
    Table<Row> rows_;
    std::vector<std::uint32_t> wanted_;  // rows
    std::uint64_t number_ = 0;
    real end_ = 0, invH_ = 0;

    void want(std::uint32_t row, bool turns);
};

/// Takes over a manifold; points that were there before keep their impulses, known by their feature
/// or, failing that, by the nearest anchor.
void adoptManifold(Contact& contact, const SweptResult& result, real matchDistance);

/// A shape on its way.
struct ShapeOnWay {
    const Convex& shape;
    const Trajectory& path;
};
/// Could the two, `gap` apart [m], come near each other within `dt` if something deflected them?
bool withinReach(const ShapeOnWay& a, const ShapeOnWay& b, real restGap, real gap, real dt);

/// Does the pair meet between the two times? Also if it is so near that the passes of a crowd could bring
/// it together unforeseen; what impacts deflect is looked at again by them.
bool mayMeet(const SweptPair& pair, real from, real to, const StepContext& context);

}  // namespace tamias2d::inline TAMIAS_PRECISION
