// SPDX-License-Identifier: MIT
#include "broadphase/sweep.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Pairs of `box` with the boxes of `others` from `first` on, which start no further left than it.
void pairWithFollowing(const SweepBox& box, const std::vector<SweepBox>& others, std::size_t first,
                       std::vector<ShapePair>& pairs)
{
    for (std::size_t k = first; k < others.size() && others[k].box.lower.x <= box.box.upper.x; ++k) {
        const SweepBox& other = others[k];
        if (other.body == box.body || !overlaps(box.box, other.box)) continue;
        pairs.push_back({minimum(box.shape, other.shape), maximum(box.shape, other.shape)});
    }
}

}  // namespace

void sweepPairs(std::vector<SweepBox>& boxes, std::vector<ShapePair>& pairs)
{
    std::sort(boxes.begin(), boxes.end(), [](const SweepBox& a, const SweepBox& b) {
        return a.box.lower.x != b.box.lower.x ? a.box.lower.x < b.box.lower.x : a.shape < b.shape;
    });

    // Movers against movers, then movers against the rest from both sides, so that two that do not
    // move are never compared.
    std::vector<SweepBox> movers, others;
    for (const SweepBox& box : boxes) (box.moves ? movers : others).push_back(box);

    pairs.clear();
    std::size_t firstOther = 0;
    for (std::size_t i = 0; i < movers.size(); ++i) {
        pairWithFollowing(movers[i], movers, i + 1, pairs);
        while (firstOther < others.size() && others[firstOther].box.lower.x < movers[i].box.lower.x)
            ++firstOther;
        pairWithFollowing(movers[i], others, firstOther, pairs);
    }
    std::size_t firstMover = 0;
    for (const SweepBox& other : others) {
        while (firstMover < movers.size() && movers[firstMover].box.lower.x <= other.box.lower.x)
            ++firstMover;
        pairWithFollowing(other, movers, firstMover, pairs);
    }
    std::sort(pairs.begin(), pairs.end());
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
