// SPDX-License-Identifier: MIT
#include "broadphase/rest_trees.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {

void RestTrees::add(std::uint32_t shape, const Aabb& box)
{
    ++changes_;
    if (shape >= places_.size()) places_.resize(std::max<std::size_t>(shape + 1, 2 * places_.size()), kNone);
    places_[shape] = static_cast<std::uint32_t>(added_.size()) | kAdded;
    added_.push_back({FloatBox::of(box), shape, 0});
    ++count_;
}

void RestTrees::remove(std::uint32_t shape)
{
    if (!holds(shape)) return;
    ++changes_;
    const std::uint32_t place = places_[shape];
    places_[shape] = kNone;
    --count_;
    if ((place & kAdded) != 0) {
        const std::uint32_t i = place & ~kAdded;
        if (i + 1 < added_.size()) {
            added_[i] = added_.back();
            places_[added_[i].shape] = i | kAdded;
        }
        added_.pop_back();
        return;
    }

    // The sibling takes the place of the parent, and all above become as small as they can.
    std::uint32_t node = nodes_[place].parent & ~kLeaf;
    if (node == kRoot) {
        const auto tree =
            std::find_if(trees_.begin(), trees_.end(), [&](const Tree& t) { return t.root == place; });
        freePairs_.push_back(place & ~1u);
        trees_.erase(tree);
        return;
    }
    const std::uint32_t sibling = place ^ 1u, above = nodes_[node].parent;
    nodes_[node] = nodes_[sibling];
    nodes_[node].parent = (above & ~kLeaf) | (nodes_[sibling].parent & kLeaf);
    if (nodes_[node].isLeaf()) {
        places_[nodes_[node].child] = node;
    } else {
        for (const std::uint32_t child : {nodes_[node].child, nodes_[node].child + 1})
            nodes_[child].parent = node | (nodes_[child].parent & kLeaf);
    }
    freePairs_.push_back(place & ~1u);
    for (std::uint32_t up = above & ~kLeaf; up != kRoot; node = up, up = nodes_[up].parent & ~kLeaf)
        nodes_[up].box = merged(nodes_[nodes_[up].child].box, nodes_[nodes_[up].child + 1].box);
    const auto tree =
        std::find_if(trees_.begin(), trees_.end(), [&](const Tree& t) { return t.root == node; });
    --tree->size;
}

void RestTrees::settle()
{
    if (added_.empty()) return;
    for (bool grew = true; grew;) {
        grew = false;
        for (std::size_t i = 0; i < trees_.size();) {
            if (trees_[i].size > 2 * added_.size()) {
                ++i;
                continue;
            }
            const std::uint32_t root = trees_[i].root;
            trees_.erase(trees_.begin() + static_cast<std::ptrdiff_t>(i));
            collect(root, true);
            grew = true;
        }
    }
    if (nodes_.empty()) nodes_.reserve(2 * added_.size());
    const std::uint32_t root = takePair();  // the other of the pair stays empty
    trees_.push_back({root, static_cast<std::uint32_t>(added_.size())});
    sortAlongCurve();
    build(root, kRoot, added_.data(), added_.data() + added_.size());
    added_.clear();
    if (added_.capacity() > 4096) added_.shrink_to_fit();
}

namespace {

// The bits of x, each two places from the next.
std::uint64_t spread(std::uint64_t x)
{
    x = (x | x << 16) & 0x0000ffff0000ffffull;
    x = (x | x << 8) & 0x00ff00ff00ff00ffull;
    x = (x | x << 4) & 0x0f0f0f0f0f0f0f0full;
    x = (x | x << 2) & 0x3333333333333333ull;
    return (x | x << 1) & 0x5555555555555555ull;
}

}  // namespace

// Morton's order of the centers, at 2^31 places along each side of the bounds of all.
void RestTrees::sortAlongCurve()
{
    const auto across = [](const FloatBox& b) { return 0.5 * b.left + 0.5 * b.right; };
    const auto along = [](const FloatBox& b) { return 0.5 * b.bottom + 0.5 * b.top; };
    double left = across(added_.front().box), bottom = along(added_.front().box), right = left, top = bottom;
    for (const Leaf& leaf : added_) {
        left = minimum(left, across(leaf.box));
        right = maximum(right, across(leaf.box));
        bottom = minimum(bottom, along(leaf.box));
        top = maximum(top, along(leaf.box));
    }
    constexpr double kPlaces = 2147483647;
    const double side = maximum(right - left, top - bottom), scale = side > 0 ? kPlaces / side : 0;
    for (Leaf& leaf : added_) {
        const auto x = static_cast<std::uint64_t>((across(leaf.box) - left) * scale);
        const auto y = static_cast<std::uint64_t>((along(leaf.box) - bottom) * scale);
        leaf.key = spread(x) | spread(y) << 1;
    }
    std::sort(added_.begin(), added_.end(), [](const Leaf& a, const Leaf& b) {
        return a.key != b.key ? a.key < b.key : a.shape < b.shape;
    });
}

std::size_t RestTrees::bytes() const
{
    return nodes_.capacity() * sizeof(Node) + freePairs_.capacity() * sizeof(std::uint32_t) +
           added_.capacity() * sizeof(Leaf) + trees_.capacity() * sizeof(Tree) +
           places_.capacity() * sizeof(std::uint32_t);
}

std::uint32_t RestTrees::takePair()
{
    if (!freePairs_.empty()) {
        const std::uint32_t pair = freePairs_.back();
        freePairs_.pop_back();
        return pair;
    }
    const auto pair = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    return pair;
}

// Halves of what lies along a curve that keeps neighbors together: balanced whatever lies where.
void RestTrees::build(std::uint32_t node, std::uint32_t parent, const Leaf* begin, const Leaf* end)
{
    if (end - begin == 1) {
        nodes_[node] = {begin->box, begin->shape, parent | kLeaf};
        places_[begin->shape] = node;
        return;
    }
    const std::uint32_t child = takePair();
    const Leaf* const middle = begin + (end - begin) / 2;
    build(child, node, begin, middle);
    build(child + 1, node, middle, end);
    nodes_[node] = {merged(nodes_[child].box, nodes_[child + 1].box), child, parent};
}

// Takes a tree apart: its leaves go back to those that were added.
void RestTrees::collect(std::uint32_t node, bool isRoot)
{
    const Node& n = nodes_[node];
    if (n.isLeaf()) {
        places_[n.child] = static_cast<std::uint32_t>(added_.size()) | kAdded;
        added_.push_back({n.box, n.child, 0});
    } else {
        const std::uint32_t child = n.child;
        collect(child, false);
        collect(child + 1, false);
        freePairs_.push_back(child);
    }
    if (isRoot) freePairs_.push_back(node);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
