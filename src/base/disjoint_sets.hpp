// SPDX-License-Identifier: MIT
// Disjoint sets of numbers: who belongs together, joined pair by pair.
#pragma once

#include <tamias2d/base/config.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The sets that `parent` tells of, which keeps its memory for the next; the lowest of each leads it.
class DisjointSets {
public:
    explicit DisjointSets(std::vector<std::uint32_t>& parent) : parent_(parent) {}

    /// So many numbers, each alone.
    void reset(std::size_t count)
    {
        parent_.resize(count);
        for (std::uint32_t i = 0; i < count; ++i) parent_[i] = i;
    }
    std::uint32_t leader(std::uint32_t i)
    {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b)
    {
        a = leader(a);
        b = leader(b);
        if (a != b) parent_[a < b ? b : a] = a < b ? a : b;
    }

private:
    std::vector<std::uint32_t>& parent_;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
