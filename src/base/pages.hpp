// SPDX-License-Identifier: MIT
// Memory of large tables: in huge pages, where the system has them to give.
#pragma once

#include <tamias2d/base/config.hpp>

#include <cstddef>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

inline constexpr std::size_t kHugePage = std::size_t{1} << 21, kCacheLine = 64;

/// From new; of a block that fills at least half a huge page whole ones are asked for. Tables of some MB are
/// walked in every tick, and to look up the addresses of thousands of small pages takes an eighth of a step
/// of 20,000 bodies. Fails as new does. The alignment is at most that of a cache line.
void* allocatePages(std::size_t bytes, std::size_t alignment);
void releasePages(void* block, std::size_t bytes, std::size_t alignment) noexcept;

/// The allocator of what a step works with.
template <class Row>
struct PageAllocator {
    using value_type = Row;

    PageAllocator() = default;
    template <class Other>
    PageAllocator(const PageAllocator<Other>&) noexcept
    {
    }
    Row* allocate(std::size_t count)
    {
        static_assert(alignof(Row) <= kCacheLine);
        return static_cast<Row*>(allocatePages(count * sizeof(Row), alignof(Row)));
    }
    void deallocate(Row* rows, std::size_t count) noexcept
    {
        releasePages(rows, count * sizeof(Row), alignof(Row));
    }
    friend bool operator==(const PageAllocator&, const PageAllocator&) { return true; }
};

/// Rows of what a step works with.
template <class Row>
using Table = std::vector<Row, PageAllocator<Row>>;

}  // namespace tamias2d::inline TAMIAS_PRECISION
