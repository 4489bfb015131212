// SPDX-License-Identifier: MIT
#pragma once

#include "base/memory.hpp"

#include <cstdint>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What only some rows of another table have: these keep the number of their row here, all others kNone.
/// Numbers are given out again, so they say nothing about order, and no result may depend on them.
template <class Row>
class SideTable {
public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    explicit SideTable(MemorySource memory = nullptr) : rows_(sourceOr(memory)), free_(sourceOr(memory)) {}

    /// The number of a row that is as new.
    std::uint32_t take()
    {
        if (free_.empty()) {
            rows_.emplace_back();
            return static_cast<std::uint32_t>(rows_.size() - 1);
        }
        const std::uint32_t number = free_.back();
        free_.pop_back();
        return number;
    }
    /// Takes it back, if there is one, and sets the number to none.
    void giveBack(std::uint32_t& number)
    {
        if (number == kNone) return;
        rows_[number] = {};
        free_.push_back(number);
        number = kNone;
    }

    Row& operator[](std::uint32_t number) { return rows_[number]; }
    const Row& operator[](std::uint32_t number) const { return rows_[number]; }
    std::size_t size() const { return rows_.size() - free_.size(); }   ///< that are in use
    std::size_t slots() const { return rows_.size(); }                 ///< that were ever in use at once
    std::size_t capacity() const { return rows_.capacity(); }
    std::size_t bytes() const { return bytesOf(rows_) + bytesOf(free_); }

private:
    Column<Row> rows_;
    Column<std::uint32_t> free_;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
