// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <array>
#include <cstddef>
#include <string_view>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What one table of a World holds.
struct TableMemory {
    std::string_view name;
    std::size_t rows = 0;      ///< in use
    std::size_t most = 0;      ///< in use at once, ever
    std::size_t capacity = 0;  ///< that fit in before it allocates again
    std::size_t bytes = 0;     ///< held, indexes included; without what names and lists in rows hold
};

/// What a World holds: the tables that last first, then those of a step.
struct MemoryReport {
    static constexpr std::size_t kTables = 12;
    std::array<TableMemory, kTables> tables{};

    std::size_t bytes() const noexcept
    {
        std::size_t sum = 0;
        for (const TableMemory& table : tables) sum += table.bytes;
        return sum;
    }
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
