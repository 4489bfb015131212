// SPDX-License-Identifier: MIT
#pragma once

#include "base/memory.hpp"

#include <tamias2d/base/ids.hpp>

#include <algorithm>
#include <functional>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Hands out the slots of a table and takes them back, lowest free slot first, so that the history
/// of a world leaves no trace in the order of its rows.
///
/// Invariant: a slot is alive exactly if its generation is odd.
template <class IdType>
class IdPool {
public:
    explicit IdPool(std::uint32_t world, MemorySource memory = nullptr)
        : world_(world), generations_(sourceOr(memory)), free_(sourceOr(memory))
    {
    }

    IdType take()
    {
        std::uint32_t slot = static_cast<std::uint32_t>(generations_.size());
        if (free_.empty()) {
            generations_.push_back(0);
        } else {
            std::pop_heap(free_.begin(), free_.end(), std::greater<>{});
            slot = free_.back();
            free_.pop_back();
        }
        ++generations_[slot];
        ++alive_;
        return id(slot);
    }

    void giveBack(std::uint32_t slot)
    {
        ++generations_[slot];
        --alive_;
        free_.push_back(slot);
        std::push_heap(free_.begin(), free_.end(), std::greater<>{});
    }

    IdType id(std::uint32_t slot) const { return {slot, generations_[slot], world_}; }
    bool isAlive(std::uint32_t slot) const { return (generations_[slot] & 1u) != 0; }
    bool owns(const IdType& given) const
    {
        return given.world == world_ && given.index < generations_.size() &&
               generations_[given.index] == given.generation && (given.generation & 1u) != 0;
    }

    std::uint32_t slots() const { return static_cast<std::uint32_t>(generations_.size()); }
    std::size_t alive() const { return alive_; }
    std::size_t bytes() const { return bytesOf(generations_) + bytesOf(free_); }

    /// What is wrong with it, in words; null if nothing is.
    const char* fault() const
    {
        std::size_t alive = 0;
        for (const std::uint32_t generation : generations_) alive += generation & 1u;
        if (alive != alive_) return "must count the live slots";
        if (free_.size() + alive != generations_.size()) return "must have each dead slot free";
        if (!std::is_heap(free_.begin(), free_.end(), std::greater<>{}))
            return "must find the lowest free slot";
        std::vector<std::uint32_t> sorted(free_.begin(), free_.end());
        std::sort(sorted.begin(), sorted.end());
        for (std::size_t i = 0; i < sorted.size(); ++i)
            if (sorted[i] >= slots() || isAlive(sorted[i]) || (i > 0 && sorted[i] == sorted[i - 1]))
                return "must have each free slot dead, and once";
        return nullptr;
    }

private:
    std::uint32_t world_;
    Column<std::uint32_t> generations_;
    Column<std::uint32_t> free_;  // a heap, lowest on top
    std::size_t alive_ = 0;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
