// SPDX-License-Identifier: MIT
#include "broadphase/tree.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {

// Sort-tile-recursive packing [Leutenegger 1997]: slices along x, each sorted along y, about as many leaves
// in a slice as there are slices.
void BoxTree::sortByPlace()
{
    const Table<SweepBox>& boxes = *boxes_;
    const auto byX = [](const Entry& a, const Entry& b) { return a.x != b.x ? a.x < b.x : a.box < b.box; };
    const auto byY = [](const Entry& a, const Entry& b) { return a.y != b.y ? a.y < b.y : a.box < b.box; };
    const auto middle = [](double lower, double upper) {
        const auto twice = static_cast<float>(lower + upper);
        return twice == twice ? twice : 0;  // what is no number has no order
    };
    entries_.resize(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const Aabb& box = boxes[i].box;
        entries_[i] = {middle(box.lower.x, box.upper.x), middle(box.lower.y, box.upper.y), i};
    }
    const std::size_t leaves = (boxes.size() + kFan - 1) / kFan;
    std::size_t slices = 1;
    while (slices * slices < leaves) ++slices;
    const std::size_t inSlice = (leaves + slices - 1) / slices * kFan;
    std::sort(entries_.begin(), entries_.end(), byX);
    for (std::size_t first = 0; first < entries_.size(); first += inSlice) {
        const std::size_t end = std::min(first + inSlice, entries_.size());
        std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(first),
                  entries_.begin() + static_cast<std::ptrdiff_t>(end), byY);
    }
}

void BoxTree::build(Table<SweepBox>& boxes, std::size_t shapeSlots)
{
    // Places of boxes that are gone need not be wiped out: a place counts if the box there is the shape's.
    boxes_ = &boxes;
    if (placeOf_.size() < shapeSlots) placeOf_.resize(shapeSlots, 0);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) placeOf_[boxes[i].shape] = i;
    sortByPlace();
    leafOf_.resize(boxes.size());
    for (std::uint32_t k = 0; k < entries_.size(); ++k) leafOf_[entries_[k].box] = k / kFan;

    // Each level bounds the one below, until one node is left.
    std::size_t below = boxes.size(), level = 0;
    for (; below > 0 && (level == 0 || below > 1); ++level) {
        if (levels_.size() == level) levels_.emplace_back();
        std::vector<Aabb>& nodes = levels_[level];
        nodes.clear();
        for (std::size_t i = 0; i < below; ++i) {
            const Aabb& box = level == 0 ? boxes[entries_[i].box].box : levels_[level - 1][i];
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
    const std::uint32_t place = placeOf_[shape];
    (*boxes_)[place].box = merged((*boxes_)[place].box, box);
    std::size_t i = leafOf_[place];
    for (std::size_t level = 0; level < height_; ++level) {
        std::vector<Aabb>& nodes = levels_[level];
        nodes[i] = merged(nodes[i], box);
        i /= kFan;
    }
}

void BoxTree::overlapping(const Aabb& box, std::uint32_t body, std::vector<std::uint32_t>& found) const
{
    found.clear();
    if (height_ > 0) visit(height_ - 1, 0, box, body, found);
    std::sort(found.begin(), found.end());
}

void BoxTree::visit(std::size_t level, std::size_t node, const Aabb& box, std::uint32_t body,
                    std::vector<std::uint32_t>& found) const
{
    const std::size_t below = level == 0 ? boxes_->size() : levels_[level - 1].size();
    const std::size_t end = std::min(below, (node + 1) * kFan);
    for (std::size_t i = node * kFan; i < end; ++i) {
        if (level > 0) {
            if (overlaps(levels_[level - 1][i], box)) visit(level - 1, i, box, body, found);
            continue;
        }
        const std::uint32_t place = entries_[i].box;
        const SweepBox& other = (*boxes_)[place];
        if (other.body != body && overlaps(other.box, box)) found.push_back(place);
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
