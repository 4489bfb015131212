// SPDX-License-Identifier: MIT
#include "base/pages.hpp"

#include "base/memory.hpp"

#include <atomic>
#include <cstdint>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

bool fillsPages(std::size_t bytes)
{
    return bytes >= kHugePage / 2;
}
std::size_t wholePages(std::size_t bytes)
{
    return (bytes + kHugePage - 1) / kHugePage * kHugePage;
}

// Equal rows of tables that all began at a page would meet in the same few places of the caches: each begins
// some cache lines farther on than the one before.
constexpr std::size_t kStagger = 73 * kCacheLine, kBeginnings = 16;
std::size_t nextBeginning()
{
    static std::atomic<std::size_t> count = 0;
    return count.fetch_add(1, std::memory_order_relaxed) % kBeginnings * kStagger;
}

}  // namespace

void* allocatePages(std::size_t bytes, std::size_t alignment)
{
    if (!fillsPages(bytes)) return ::operator new(bytes, std::align_val_t(alignment));
    const std::size_t begin = nextBeginning(), size = wholePages(begin + bytes);
    void* const block = ::operator new(size, std::align_val_t(kHugePage));
#ifdef MADV_HUGEPAGE
    static_cast<void>(madvise(block, size, MADV_HUGEPAGE));  // a wish: small pages serve as well
#endif
    return static_cast<std::byte*>(block) + begin;
}

void releasePages(void* block, std::size_t bytes, std::size_t alignment) noexcept
{
    if (!fillsPages(bytes)) {
        ::operator delete(block, std::align_val_t(alignment));
        return;
    }
    const std::size_t begin = reinterpret_cast<std::uintptr_t>(block) % kHugePage;
    ::operator delete(static_cast<std::byte*>(block) - begin, std::align_val_t(kHugePage));
}

namespace {

class PageSource final : public std::pmr::memory_resource {
    void* do_allocate(std::size_t bytes, std::size_t alignment) override
    {
        return allocatePages(bytes, alignment);
    }
    void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override
    {
        releasePages(block, bytes, alignment);
    }
    bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

}  // namespace

MemorySource pageSource()
{
    static PageSource* const source = new PageSource;  // outlives every World
    return source;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
