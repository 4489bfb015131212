// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Solves H x = b for a sparse symmetric positive matrix of 3x3 blocks, one row of blocks a node: H = L D L^T
/// in an order that keeps L sparse. A tree fills nothing in.
class BlockLdl {
public:
    using Edge = std::pair<int, int>;
    struct Block {
        double a[9] = {};  // row by row
    };

    /// Finds the order, and where the blocks of L are, for nodes tied by `edges`. Ties in the order go to the
    /// lowest node, so the same pattern has always the same bits.
    void analyze(int nodes, const std::vector<Edge>& edges);

    /// Sets H to zero.
    void clear();
    Block& diagonal(int node) { return diagonals_[at(places_, node)]; }
    /// The block that ties two different nodes, and whether it is to be added transposed.
    std::pair<Block*, bool> between(int row, int column);

    /// Turns H into its factors. False if H was not positive to rounding; then it must not be solved with.
    bool factor();
    /// `x` holds b before and the solution after, three numbers a node.
    void solve(std::vector<double>& x);

    /// Blocks of L below its diagonal: what a factorization costs grows with it.
    std::size_t fill() const { return rows_.size(); }

private:
    static std::size_t at(const std::vector<int>& list, int i)
    {
        return static_cast<std::size_t>(list[static_cast<std::size_t>(i)]);
    }
    std::size_t find(int row, int column) const;

    std::vector<int> order_, places_;  // which node is eliminated when, and the reverse
    std::vector<std::size_t> starts_;  // of each column in `rows_`
    std::vector<int> rows_;  // places below the diagonal
    std::vector<std::size_t> targets_;  // of each update of a block, in order: of the diagonal first
    std::vector<Block> lower_, diagonals_;  // by place: H before, L and D^-1 after
    std::vector<Block> scaled_;  // scratch: a column of L D
    std::vector<double> work_;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
