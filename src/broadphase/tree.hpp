// SPDX-License-Identifier: MIT
#pragma once

#include "broadphase/sweep.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// A tree of bounds over boxes, for questions in mid-step: eight boxes a leaf, eight nodes a node, no
/// pointers. Boxes may grow; they keep their places.
class BoxTree {
public:
    /// Takes in the boxes as they stand; `boxes` must live and keep its order as long as questions are asked.
    void build(Table<SweepBox>& boxes, std::size_t shapeSlots);
    void clear() { boxes_ = nullptr; }
    bool isBuilt() const { return boxes_ != nullptr; }

    /// The box of a shape; null if it has none.
    const SweepBox* boxOf(std::uint32_t shape) const;
    /// Grows the box of a shape that has one.
    void grow(std::uint32_t shape, const Aabb& box);
    /// The boxes that overlap `box`, of shapes of other bodies than `body`, as indices into the boxes,
    /// rising.
    void overlapping(const Aabb& box, std::uint32_t body, std::vector<std::uint32_t>& found) const;

private:
    static constexpr std::size_t kFan = 8;

    Table<SweepBox>* boxes_ = nullptr;
    std::vector<std::uint32_t> placeOf_;  // by shape slot
    struct Entry {
        float x, y;  // of twice the middle of the box: only neighborhood depends on it
        std::uint32_t box;  // its index
    };
    std::vector<Entry> entries_;  // all boxes, neighbors in space beside each other
    std::vector<std::uint32_t> leafOf_;  // by box
    std::vector<std::vector<Aabb>> levels_;  // the first over kFan entries each, the top has one node
    std::size_t height_ = 0;  // levels in use; those above only keep their memory

    void sortByPlace();
    void visit(std::size_t level, std::size_t node, const Aabb& box, std::uint32_t body,
               std::vector<std::uint32_t>& found) const;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
