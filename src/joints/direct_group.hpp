// SPDX-License-Identifier: MIT
// A group of joints, and contacts, that is solved at once: docs/theory/joints.md, section 7.
#pragma once

#include "joints/block_ldl.hpp"
#include "joints/rows.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// A group of joints and the bodies it holds, with the matrix that ties these. Keeps its memory, and its
/// order of elimination as long as the same bodies are tied.
struct DirectGroup {
    std::vector<std::uint32_t> rows;      // of its bodies in the MotionTable, in order: the nodes
    std::vector<std::uint32_t> joints;    // places among the JointRows
    std::vector<JointRows> contacts;      // as rows of the tick at hand; none in most groups
    std::vector<BlockLdl::Edge> nodes;  // by joint, then by contact: of its bodies; -1 for one nothing moves
    bool loops = false;  // do joints tie bodies round, so that their rows may repeat each other?
    double negligible = 0;  // of contacts: how fast they may close   [m/s]
    std::vector<int> moreNodes;  // of those beyond two, likewise, joint by joint
    std::vector<std::size_t> moreFrom;  // by joint: where its own begin there
    BlockLdl matrix;

    // Of the half of a tick at hand, where ties at a distance resist turning: what the group has changed.
    bool begins = true;  // its first visit is to come
    std::vector<double> given;  // three numbers a node   [m/s], [rad/s]

    std::vector<double> turnStiffness;  // by node, added to its moment of inertia; empty: none   [kg*m^2]

    // Of the solve at hand.
    std::vector<double> start, velocity, step, left, kept;  // three numbers a node
    std::vector<double> impulses, before;  // by joint and row
    std::vector<std::uint32_t> bearing;  // rows that hold the bodies together: places among the impulses
    std::vector<double> speeds;  // along these
    std::vector<std::uint16_t> states;  // by joint: at which bounds its rows are
    std::vector<std::uint16_t> factored;  // likewise, of the factors at hand

    int analyzedNodes = -1;
    std::vector<BlockLdl::Edge> analyzed;
    std::vector<BlockLdl::Edge> edges;  // scratch

    /// Finds nodes and order; cheap if nothing has changed since.
    void build(const std::vector<JointRows>& all, const Table<Motion>& motions);
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
