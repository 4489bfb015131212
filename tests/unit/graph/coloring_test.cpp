// SPDX-License-Identifier: MIT
#include "graph/coloring.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace tamias2d {
namespace {

// The order is by color: as long as no movable row repeats, the run may be solved side by side.
int runsWithoutRepeats(const std::vector<RowPair>& pairs, const std::vector<bool>& movable,
                       const std::vector<std::uint32_t>& order)
{
    int runs = 1;
    std::set<std::uint32_t> seen;
    std::uint32_t last = 0;
    for (const std::uint32_t i : order) {
        const bool repeats = (movable[pairs[i].a] && seen.count(pairs[i].a)) ||
                             (movable[pairs[i].b] && seen.count(pairs[i].b));
        if (repeats || i < last) {
            ++runs;
            seen.clear();
        }
        last = i;
        seen.insert({pairs[i].a, pairs[i].b});
    }
    return runs;
}

TEST(Coloring, NoColorHoldsABodyTwice)
{
    TRACES("ADR11");
    std::mt19937 random(6);
    std::vector<bool> movable(60, true);
    movable[0] = false;  // a ground that everything touches
    std::vector<RowPair> pairs;
    std::vector<int> degree(60, 0);
    for (int i = 0; i < 150; ++i) {
        const std::uint32_t a = i % 4 == 0 ? 0 : std::uint32_t(random() % 60),
                            b = std::uint32_t(1 + random() % 59);
        if (a == b) continue;
        pairs.push_back({a, b});
        ++degree[a];
        ++degree[b];
    }
    std::vector<std::uint32_t> order, ends;
    ColorScratch scratch;
    colorConstraints(pairs, movable, order, ends, scratch);
    ASSERT_EQ(order.size(), pairs.size());
    EXPECT_EQ(std::set<std::uint32_t>(order.begin(), order.end()).size(), pairs.size());
    const int most = *std::max_element(degree.begin() + 1, degree.end());
    EXPECT_LE(runsWithoutRepeats(pairs, movable, order), 2 * most - 1);  // the bound of greedy coloring
    EXPECT_EQ(ends.back(), order.size());
    EXPECT_TRUE(std::is_sorted(ends.begin(), ends.end()));
    std::uint32_t from = 0;
    for (std::size_t color = 0; color + 1 < ends.size(); from = ends[color++]) {
        std::set<std::uint32_t> rows;
        for (std::uint32_t k = from; k < ends[color]; ++k)
            for (const std::uint32_t row : {pairs[order[k]].a, pairs[order[k]].b}) {
                EXPECT_TRUE(!movable[row] || rows.insert(row).second) << "row " << row << " twice in a color";
            }
    }
}

TEST(Coloring, ABodyWithMoreContactsThanColorsIsStillSolved)
{
    TRACES("ADR11");
    std::vector<RowPair> pairs;
    for (std::uint32_t i = 1; i <= 200; ++i) pairs.push_back({0, i});
    std::vector<std::uint32_t> order, ends;
    ColorScratch scratch;
    colorConstraints(pairs, std::vector<bool>(201, true), order, ends, scratch);
    EXPECT_EQ(std::set<std::uint32_t>(order.begin(), order.end()).size(), 200u);
}

}  // namespace
}  // namespace tamias2d
