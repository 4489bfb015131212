// SPDX-License-Identifier: MIT
#pragma once

#include "contacts/row_kernel.hpp"
#include "model/contacts.hpp"

#include <cstdint>

namespace tamias2d::inline TAMIAS_PRECISION {

/// W contacts of one color side by side, as the passes need them. An empty lane has zeros in all places,
/// which move nothing. Sets of lanes are bits, lane 0 lowest.
template <int W>
struct ContactBlock {
    ContactRow<Lane<W>> row;
    std::uint32_t rowA[W] = {}, rowB[W] = {}, island[W] = {};
    std::uint32_t active = 0;                // lanes with a contact
    std::uint32_t out = 0;                   // lanes with one that sits out for now
    std::uint32_t movesA = 0, movesB = 0;    // lanes whose body can be pushed
    std::uint32_t two = 0;                   // lanes with two points
    std::uint32_t unloaded[2] = {};          // lanes of which a point carried nothing as the tick began
    bool oneIsland = true;                   // are all lanes of the same?

    int points() const { return (active & two) != 0 ? 2 : 1; }
};

/// What only preparing, pushing and adding up need of them. The names are those of Contact.
template <int W>
struct ContactSource {
    using Wide = Lane<W>;
    std::uint32_t contact[W] = {};
    std::uint32_t elastic = 0;         // lanes that may bounce
    std::uint32_t atImpact = 0;        // lanes whose manifold is that of a moment of impact
    std::uint32_t touching = 0;        // lanes that touched at the end of the last step
    BasicVec2<Wide> start;             // from A to B at the start of the step   [m]
    Wide restGap, radiusA, radiusB;
    BasicVec2<Wide> localA[2], localB[2];
    LaneMask<W> cornerOnA[2] = {}, present[2] = {};
    LaneMask<W> turns = {};            // lanes whose normal goes along: see normalTurns
    Wide slowest;                      // see leastApproach   [m/s]
    Wide gap[2];
    Wide stepNormal[2], stepTangent[2];
    BasicVec2<Wide> stepImpulse;
    LaneMask<W> counted = {};          // lanes whose impulses are to be added up at the end of the tick
    Wide pushed;
};

template <int W>
void setLane(BasicVec2<Lane<W>>& wide, int lane, Vec2 value)
{
    wide.x.v[lane] = value.x;
    wide.y.v[lane] = value.y;
}
template <int W>
Vec2 laneOf(const BasicVec2<Lane<W>>& wide, int lane)
{
    return {wide.x.v[lane], wide.y.v[lane]};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
