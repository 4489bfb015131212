// SPDX-License-Identifier: MIT
#include "broadphase/sweep.hpp"
#include "support/boxes.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tamias2d {
namespace {

std::vector<ShapePair> pairsByBruteForce(const Table<SweepBox>& boxes)
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
        Table<SweepBox> boxes = randomBoxes(seed < 20 ? 200 : 2000, seed);
        const std::vector<ShapePair> expected = pairsByBruteForce(boxes);
        std::vector<ShapePair> pairs;
        SweepScratch scratch;
        Profile profile;
        Parallel parallel(1 + static_cast<int>(seed % 3), nullptr, profile);
        sweepPairs(boxes, {}, pairs, scratch, parallel);
        EXPECT_EQ(pairs, expected) << "seed " << seed << ": " << pairs.size() << " pairs instead of "
                                   << expected.size();
    }
}

// n boxes of bodies of their own, of which every third does not move.
template <class Place>
Table<SweepBox> boxesAt(std::uint32_t n, Place place)
{
    Table<SweepBox> boxes;
    for (std::uint32_t i = 0; i < n; ++i) boxes.push_back({place(i), i, i, i % 3 != 0});
    return boxes;
}

TEST(Sweep, FindsThemHoweverTheWorldIsLaidOut)
{
    TRACES("R7", "T5", "NFR1");
    const auto square = [](double x, double y, double size) {
        return Aabb{{x - size, y - size}, {x + size, y + size}};
    };
    std::mt19937 random(7);
    std::uniform_real_distribution<double> exponent(-9, 9), side(-1, 1);
    const auto any = [&] { return side(random) * std::pow(10, exponent(random)); };
    const std::vector<std::pair<const char*, Table<SweepBox>>> worlds{
        {"none", {}},
        {"one", boxesAt(1, [&](auto) { return square(0, 0, 1); })},
        {"a tall column", boxesAt(300, [&](auto i) { return square(0, i, 0.51); })},
        {"a long row", boxesAt(300, [&](auto i) { return square(i, 0, 0.51); })},
        {"all at one place", boxesAt(80, [&](auto) { return square(3, -4, 1); })},
        {"a column and one that fell out of the world",
         boxesAt(300, [&](auto i) { return square(0, i == 7 ? -1e9 : double(i), 0.51); })},
        {"all of one height", boxesAt(200, [&](auto i) { return square(i % 20, i / 20, 0.5); })},
        {"walls as high as the world",
         boxesAt(200,
                 [&](auto i) { return Aabb{{i * 0.5, -50}, {i * 0.5 + 0.6, i % 5 == 0 ? 50.0 : -49.0}}; })},
        {"points and lines", boxesAt(200,
                                     [&](auto i) {
                                         return Aabb{{double(i % 9), double(i % 7)},
                                                     {double(i % 9), double(i % 7 + i % 2)}};
                                     })},
        {"far away", boxesAt(200, [&](auto i) { return square(1e9 + i * 0.3, -1e9 + i % 9 * 0.3, 0.2); })},
        {"all sizes at all places",
         boxesAt(300, [&](auto) { return square(any(), any(), std::abs(any())); })},
    };
    SweepScratch scratch;
    Profile profile;
    Parallel parallel(1, nullptr, profile);
    for (const auto& [name, boxes] : worlds) {
        std::vector<ShapePair> pairs;
        sweepPairs(boxes, {}, pairs, scratch, parallel);
        EXPECT_EQ(pairs, pairsByBruteForce(boxes)) << name;
    }
}

TEST(Sweep, ForgetsTheOrderInWhichBoxesWereGiven)
{
    TRACES("ADR6");
    Table<SweepBox> forward = randomBoxes(150, 5), backward = forward;
    std::reverse(backward.begin(), backward.end());
    std::vector<ShapePair> one, other;
    SweepScratch scratch;
    Profile profile;
    Parallel parallel(1, nullptr, profile);
    sweepPairs(forward, {}, one, scratch, parallel);
    sweepPairs(backward, {}, other, scratch, parallel);
    EXPECT_EQ(one, other);
}

TEST(Sweep, TouchingEdgesAreAPairAndBoxesAtRestAreNone)
{
    TRACES("T5");
    Table<SweepBox> boxes{
        {{{0, 0}, {1, 1}}, 0, 0, true}, {{{1, 0}, {2, 1}}, 1, 1, false}, {{{1.5, 0}, {3, 1}}, 2, 2, false}};
    std::vector<ShapePair> pairs;
    SweepScratch scratch;
    Profile profile;
    Parallel parallel(1, nullptr, profile);
    sweepPairs(boxes, {}, pairs, scratch, parallel);
    EXPECT_EQ(pairs, (std::vector<ShapePair>{{0, 1}}));
}

}  // namespace
}  // namespace tamias2d
