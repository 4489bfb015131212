// SPDX-License-Identifier: MIT
#include "broadphase/tree.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {

void BoxTree::build(std::vector<SweepBox>& boxes, std::size_t shapeSlots)
{
    // Places of boxes that are gone need not be wiped out: a place counts if the box there is the shape's.
    boxes_ = &boxes;
    if (placeOf_.size() < shapeSlots) placeOf_.resize(shapeSlots, 0);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) placeOf_[boxes[i].shape] = i;

    // Each level bounds the one below, until one node is left.
    std::size_t below = boxes.size(), level = 0;
    for (; below > 0 && (level == 0 || below > 1); ++level) {
        if (levels_.size() == level) levels_.emplace_back();
        std::vector<Aabb>& nodes = levels_[level];
        nodes.clear();
        for (std::size_t i = 0; i < below; ++i) {
            const Aabb& box = level == 0 ? boxes[i].box : levels_[level - 1][i];
            if (i % kFan == 0)
                nodes.push_back(box);
            else
                nodes.back() = merged(nodes.back(), box);
        }
        below = nodes.size();
    }
    height_ = level;
}

const SweepBox* BoxTree::boxOf(std::uint32_t shape) const
{
    if (shape >= placeOf_.size() || placeOf_[shape] >= boxes_->size()) return nullptr;
    const SweepBox& box = (*boxes_)[placeOf_[shape]];
    return box.shape == shape ? &box : nullptr;
}

void BoxTree::grow(std::uint32_t shape, const Aabb& box)
{
    std::size_t i = placeOf_[shape];
    (*boxes_)[i].box = merged((*boxes_)[i].box, box);
    for (std::size_t level = 0; level < height_; ++level) {
        i /= kFan;
        std::vector<Aabb>& nodes = levels_[level];
        nodes[i] = merged(nodes[i], box);
    }
}

void BoxTree::overlapping(const Aabb& box, std::uint32_t body, std::vector<std::uint32_t>& found) const
{
    found.clear();
    if (height_ > 0) visit(height_ - 1, 0, box, body, found);
}

void BoxTree::visit(std::size_t level, std::size_t node, const Aabb& box, std::uint32_t body,
                    std::vector<std::uint32_t>& found) const
{
    if (!overlaps(levels_[level][node], box)) return;
    const std::size_t below = level == 0 ? boxes_->size() : levels_[level - 1].size();
    const std::size_t end = std::min(below, (node + 1) * kFan);
    for (std::size_t i = node * kFan; i < end; ++i) {
        if (level > 0)
            visit(level - 1, i, box, body, found);
        else if ((*boxes_)[i].body != body && overlaps((*boxes_)[i].box, box))
            found.push_back(static_cast<std::uint32_t>(i));
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
