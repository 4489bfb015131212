// SPDX-License-Identifier: MIT
#include "base/pages.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <tamias2d/math/vec2.hpp>

#include <cstdint>
#include <numeric>
#include <set>

namespace tamias2d::test {
namespace {

struct alignas(64) Wide {
    real value = 0;
};

std::uintptr_t addressOf(const void* place)
{
    return reinterpret_cast<std::uintptr_t>(place);
}

}  // namespace

TEST(Pages, TablesOfEverySizeKeepTheirRowsAndAlignment)
{
    TRACES("NFR1", "R4");
    Table<Wide> wide;
    Table<std::uint32_t> numbers;
    for (std::size_t size = 1; size * sizeof(Wide) < 5 * kHugePage; size = size * 3 / 2 + 1) {
        wide.resize(size);
        wide.back().value = static_cast<real>(size);
        numbers.resize(size);
        std::iota(numbers.begin(), numbers.end(), 0u);
        EXPECT_EQ(addressOf(wide.data()) % alignof(Wide), 0u) << size;
        EXPECT_EQ(addressOf(numbers.data()) % alignof(std::uint32_t), 0u) << size;
    }
    std::size_t size = 1;
    for (; size * sizeof(Wide) < 5 * kHugePage; size = size * 3 / 2 + 1)
        EXPECT_EQ(wide[size - 1].value, static_cast<real>(size));
    for (std::size_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], i);
}

TEST(Pages, LargeTablesDoNotMeetInTheSameCacheLines)
{
    TRACES("NFR1");
    std::vector<Table<Wide>> tables(8);
    std::set<std::uintptr_t> sets;
    for (Table<Wide>& table : tables) {
        table.resize(kHugePage / sizeof(Wide));
        sets.insert(addressOf(table.data()) / 64 % 64);  // of 4 KB, eight ways of a first-level cache
    }
    EXPECT_EQ(sets.size(), tables.size());
}

}  // namespace tamias2d::test
