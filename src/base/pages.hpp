// SPDX-License-Identifier: MIT
// Memory of large tables: in huge pages, where the system has them to give.
#pragma once

#include <tamias2d/base/config.hpp>

#include <cstddef>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

inline constexpr std::size_t kHugePage = std::size_t{1} << 21;

/// From new; of a block that fills at least half a huge page whole ones are asked for. Tables of some MB are
/// walked in every tick, and a step that looks up the addresses of thousands of small pages is up to a fourth
/// slower. Fails as new does.
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
