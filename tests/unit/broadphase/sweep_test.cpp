// SPDX-License-Identifier: MIT
#include "broadphase/sweep.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace tamias2d {
namespace {

std::vector<SweepBox> randomBoxes(std::uint32_t count, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-20, 20), size(0, 3);
    std::vector<SweepBox> boxes;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Position lower{place(random), place(random)};
        const DVec2 extent{i % 17 == 0 ? 40.0 : size(random), size(random)};
        boxes.push_back({{lower, lower + extent}, i, i / 2, i % 3 != 0});  // two shapes a body
    }
    return boxes;
}

std::vector<ShapePair> pairsByBruteForce(const std::vector<SweepBox>& boxes)
{
    std::vector<ShapePair> pairs;
    for (const SweepBox& a : boxes)
        for (const SweepBox& b : boxes)
            if (a.shape < b.shape && a.body != b.body && (a.moves || b.moves) && overlaps(a.box, b.box))
                pairs.push_back({a.shape, b.shape});
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

TEST(Sweep, FindsThePairsThatComparingAllWithAllFinds)
{
    TRACES("R7", "T5");
    for (unsigned seed = 1; seed <= 20; ++seed) {
        std::vector<SweepBox> boxes = randomBoxes(200, seed);
        const std::vector<ShapePair> expected = pairsByBruteForce(boxes);
        std::vector<ShapePair> pairs;
        sweepPairs(boxes, pairs);
        EXPECT_EQ(pairs, expected) << "seed " << seed << ": " << pairs.size() << " pairs instead of "
                                   << expected.size();
    }
}

TEST(Sweep, ForgetsTheOrderInWhichBoxesWereGiven)
{
    TRACES("ADR6");
    std::vector<SweepBox> forward = randomBoxes(150, 5), backward = forward;
    std::reverse(backward.begin(), backward.end());
    std::vector<ShapePair> one, other;
    sweepPairs(forward, one);
    sweepPairs(backward, other);
    EXPECT_EQ(one, other);
}

TEST(Sweep, TouchingEdgesAreAPairAndBoxesAtRestAreNone)
{
    TRACES("T5");
    std::vector<SweepBox> boxes{
        {{{0, 0}, {1, 1}}, 0, 0, true}, {{{1, 0}, {2, 1}}, 1, 1, false}, {{{1.5, 0}, {3, 1}}, 2, 2, false}};
    std::vector<ShapePair> pairs;
    sweepPairs(boxes, pairs);
    EXPECT_EQ(pairs, (std::vector<ShapePair>{{0, 1}}));
}

}  // namespace
}  // namespace tamias2d
