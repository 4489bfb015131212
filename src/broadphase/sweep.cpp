// SPDX-License-Identifier: MIT
#include "broadphase/sweep.hpp"

#include "broadphase/float_box.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

using Entry = SweepScratch::Entry;

constexpr double kBoxesPerStrip = 4;   // a strip is as high as this many boxes
constexpr std::int64_t kMaxStrips = 16;   // a box in that many of them is huge

// From how many there are to where each begins.
void startsOf(std::vector<std::uint32_t>& counts)
{
    std::uint32_t start = 0;
    for (std::uint32_t& count : counts) count = (start += count) - count;
}

// Strips along x, all of one height, counted from y = 0. So that a body far away makes no more of them, they
// are kept in a ring of buckets: boxes of several strips may share one.
struct Strips {
    double invHeight = 1;
    std::uint32_t buckets = 1;   // a power of two

    std::int64_t at(double y) const
    {
        constexpr double kMost = 1e15;
        const double strip = std::floor(y * invHeight);
        return strip > -kMost ? static_cast<std::int64_t>(minimum(strip, kMost))
                              : -static_cast<std::int64_t>(kMost);
    }
    std::uint32_t bucketOf(std::int64_t strip) const
    {
        return static_cast<std::uint32_t>(strip) & (buckets - 1);
    }
};

// Some times as high as half of the boxes are, to a power of two.
Strips layOut(const Table<SweepBox>& boxes)
{
    constexpr int kLeast = -64, kMost = 64;
    std::uint32_t counts[kMost - kLeast + 1] = {};
    for (const SweepBox& b : boxes) {
        const double height = b.box.upper.y - b.box.lower.y;
        const int exponent = height > 0 ? std::ilogb(height) : kLeast;
        ++counts[clamp(exponent, kLeast, kMost) - kLeast];
    }
    std::size_t lower = 0;
    int exponent = kLeast;
    while ((lower += counts[exponent - kLeast]) < (boxes.size() + 1) / 2) ++exponent;

    Strips strips;
    strips.invHeight = std::ldexp(1 / kBoxesPerStrip, -exponent);
    while (strips.buckets < boxes.size() / 4) strips.buckets *= 2;
    return strips;
}

// Puts each box into the strips it reaches, sorted by bucket.
void fillStrips(const Table<SweepBox>& boxes, const Strips& strips, SweepScratch& scratch)
{
    scratch.unsorted.clear();
    scratch.huge.clear();
    scratch.bucketEnds.assign(strips.buckets, 0);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const Aabb& box = boxes[i].box;
        const std::int64_t first = strips.at(box.lower.y), last = strips.at(box.upper.y);
        if (last - first >= kMaxStrips) {
            scratch.huge.push_back(i);
            continue;
        }
        Entry entry{floatBelow(box.lower.x),
                    floatAbove(box.upper.x),
                    floatBelow(box.lower.y),
                    floatAbove(box.upper.y),
                    i,
                    first};
        for (; entry.strip <= last; ++entry.strip) {
            scratch.unsorted.push_back(entry);
            ++scratch.bucketEnds[strips.bucketOf(entry.strip)];
        }
    }
    startsOf(scratch.bucketEnds);
    scratch.entries.resize(scratch.unsorted.size());
    for (const Entry& entry : scratch.unsorted)
        scratch.entries[scratch.bucketEnds[strips.bucketOf(entry.strip)]++] = entry;
}

void addPair(const SweepBox& a, const SweepBox& b, std::vector<ShapePair>& found)
{
    if ((a.moves || b.moves) && a.body != b.body && overlaps(a.box, b.box))
        found.push_back({minimum(a.shape, b.shape), maximum(a.shape, b.shape)});
}

// Sweeps a bucket. A pair that lies in several strips counts in the lowest that both are in.
void sweepBucket(const Table<SweepBox>& boxes, const Strips& strips, Entry* begin, Entry* end,
                 std::vector<ShapePair>& found)
{
    std::sort(begin, end, [](const Entry& a, const Entry& b) {
        return a.left != b.left ? a.left < b.left : a.box < b.box;
    });
    for (const Entry* one = begin; one != end; ++one) {
        for (const Entry* other = one + 1; other != end && other->left <= one->right; ++other) {
            if (other->strip != one->strip || other->bottom > one->top || other->top < one->bottom) continue;
            const SweepBox &a = boxes[one->box], &b = boxes[other->box];
            if (strips.at(maximum(a.box.lower.y, b.box.lower.y)) == one->strip) addPair(a, b, found);
        }
    }
}

// Counting by the first shape, then the few of each by the second.
void sortPairs(const std::vector<ShapePair>& found, std::vector<ShapePair>& pairs,
               std::vector<std::uint32_t>& ends)
{
    std::uint32_t shapes = 0;
    for (const ShapePair& pair : found) shapes = maximum(shapes, pair.a + 1);
    if (shapes > 8 * found.size()) {  // a few among many
        pairs = found;
        std::sort(pairs.begin(), pairs.end());
        return;
    }
    ends.assign(shapes, 0);
    for (const ShapePair& pair : found) ++ends[pair.a];
    startsOf(ends);
    pairs.resize(found.size());
    for (const ShapePair& pair : found) pairs[ends[pair.a]++] = pair;
    std::uint32_t start = 0;
    for (const std::uint32_t end : ends) {
        std::sort(pairs.begin() + start, pairs.begin() + end);
        start = end;
    }
}

}  // namespace

void sweepPairs(const Table<SweepBox>& boxes, std::span<const ShapePair> more, std::vector<ShapePair>& pairs,
                SweepScratch& scratch, Parallel& parallel)
{
    scratch.found.assign(more.begin(), more.end());
    if (!boxes.empty()) {
        const Strips strips = layOut(boxes);
        fillStrips(boxes, strips, scratch);
        constexpr std::size_t kBuckets = 64;
        scratch.ofChunks.begin(Parallel::chunksOf(scratch.bucketEnds.size(), kBuckets));
        parallel.forEach(scratch.bucketEnds.size(), kBuckets, [&](const Chunk& chunk) {
            Entry* const entries = scratch.entries.data();
            for (std::size_t k = chunk.begin; k < chunk.end; ++k)
                sweepBucket(boxes, strips, entries + (k == 0 ? 0 : scratch.bucketEnds[k - 1]),
                            entries + scratch.bucketEnds[k], scratch.ofChunks.of(chunk.index));
        });
        scratch.ofChunks.forAll([&](const ShapePair& pair) { scratch.found.push_back(pair); });
        for (std::size_t k = 0; k < scratch.huge.size(); ++k) {
            const SweepBox& huge = boxes[scratch.huge[k]];
            for (std::uint32_t i = 0, next = 0; i < boxes.size(); ++i) {
                const bool isHuge = next < scratch.huge.size() && scratch.huge[next] == i;
                if (isHuge && next++ <= k) continue;  // two huge ones are a pair once
                addPair(huge, boxes[i], scratch.found);
            }
        }
    }
    sortPairs(scratch.found, pairs, scratch.pairEnds);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
