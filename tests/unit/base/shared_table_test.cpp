// SPDX-License-Identifier: MIT
#include "base/shared_table.hpp"

#include "base/side_table.hpp"
#include "support/random.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <map>

namespace tamias2d {
namespace {

// A number, with a hash so poor that most share it with others.
struct Key {
    int value;
    std::uint64_t hash() const { return static_cast<std::uint64_t>(value % 5); }
    bool matches(int row) const { return row == value; }
    int make() const { return value; }
};

TEST(SharedTable, HoldsEachDifferentRowOnceForAsLongAsSomebodyUsesIt)
{
    TRACES("NFR1");
    SharedTable<int> table;
    std::map<int, std::uint32_t> users;                // by value: the truth
    std::vector<std::pair<std::uint32_t, int>> held;   // number, value
    test::Random random(3);
    for (int i = 0; i < 20000; ++i) {
        // Grows at first, shrinks to nothing and grows again.
        const bool takes = held.empty() || random.between(0, 1) < (i / 4000 % 2 == 0 ? 0.7 : 0.3);
        if (takes) {
            const int value = static_cast<int>(random.between(0, 200));
            const std::uint32_t number = table.take(Key{value});
            ASSERT_EQ(table[number], value);
            held.emplace_back(number, value);
            ++users[value];
        } else {
            const auto at = static_cast<std::size_t>(random.between(0, static_cast<double>(held.size())));
            std::swap(held[at], held.back());
            auto [number, value] = held.back();
            held.pop_back();
            if (--users[value] == 0) users.erase(value);
            table.giveBack(number);
            EXPECT_EQ(number, SharedTable<int>::kNone);
        }
        ASSERT_EQ(table.size(), users.size());
    }
    EXPECT_GT(held.size(), 100u);
    for (const auto& [number, value] : held) {
        EXPECT_EQ(table[number], value);
        EXPECT_EQ(table.users(number), users[value]);
    }
    EXPECT_LE(table.slots(), 200u);
}

TEST(SideTable, GivesRowsThatAreAsNew)
{
    TRACES("NFR1");
    SideTable<int> table;
    std::uint32_t first = table.take(), second = table.take();
    table[first] = 1;
    table[second] = 2;
    EXPECT_EQ(table.size(), 2u);
    table.giveBack(first);
    EXPECT_EQ(first, SideTable<int>::kNone);
    EXPECT_EQ(table.size(), 1u);
    table.giveBack(first);   // none: nothing happens
    EXPECT_EQ(table.size(), 1u);
    first = table.take();
    EXPECT_EQ(table[first], 0);
    EXPECT_EQ(table[second], 2);
    EXPECT_EQ(table.slots(), 2u);
}

}  // namespace
}  // namespace tamias2d
