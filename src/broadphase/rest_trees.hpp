// SPDX-License-Identifier: MIT
#pragma once

#include "broadphase/float_box.hpp"

#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The boxes of what does not move, for questions of those that do: a few balanced trees. What is added
/// becomes a tree of its own, together with all trees that are not larger than twice the sum so far; so there
/// are never more than a logarithm of them, whatever comes in whatever order, and what rests costs nothing.
/// What is removed leaves its tree, which never grows deeper.
class RestTrees {
public:
    /// Adds a shape that is not here. It is found from the next settle() on.
    void add(std::uint32_t shape, const Aabb& box);
    /// Removes a shape, if it is here.
    void remove(std::uint32_t shape);
    bool holds(std::uint32_t shape) const { return shape < places_.size() && places_[shape] != kNone; }
    std::size_t size() const { return count_; }
    /// Builds a tree of what was added.
    void settle();

    /// Calls visit(shape) for every shape whose box, rounded outwards, overlaps `box`; in no order that means
    /// anything.
    template <class Visit>
    void eachOverlapping(const Aabb& box, Visit visit) const
    {
        const FloatBox wanted = FloatBox::of(box);
        std::uint32_t stack[kDeepest];
        for (const Tree& tree : trees_) {
            std::uint32_t depth = 0;
            stack[depth++] = tree.root;
            while (depth > 0) {
                const Node& node = nodes_[stack[--depth]];
                if (!overlaps(node.box, wanted)) continue;
                if (node.isLeaf()) {
                    visit(node.child);
                } else {
                    stack[depth++] = node.child + 1;
                    stack[depth++] = node.child;
                }
            }
        }
    }

    std::size_t treeCount() const { return trees_.size(); }  ///< for tests
    std::size_t bytes() const;  ///< of memory held

private:
    static constexpr std::uint32_t kNone = 0xffffffffu;
    static constexpr std::uint32_t kAdded = 0x80000000u;  // in places_: an index into added_
    static constexpr std::uint32_t kLeaf = 0x80000000u;  // in Node::parent
    static constexpr std::uint32_t kRoot = 0x7fffffffu;  // parent of a root
    static constexpr std::size_t kDeepest = 72;  // trees are balanced: twice 32 and some

    /// Children lie side by side, at `child` and `child + 1`; a leaf has its shape there.
    struct Node {
        FloatBox box;
        std::uint32_t child;
        std::uint32_t parent;  // with kLeaf; of a root: kRoot

        bool isLeaf() const { return (parent & kLeaf) != 0; }
    };
    struct Leaf {
        FloatBox box;
        std::uint32_t shape;
        std::uint64_t key;
    };
    struct Tree {
        std::uint32_t root;
        std::uint32_t size;  // leaves
    };

    std::vector<Node> nodes_;  // in pairs; the first of a pair is even
    std::vector<std::uint32_t> freePairs_;
    std::vector<Tree> trees_;
    std::vector<Leaf> added_;  // not in a tree yet
    std::vector<std::uint32_t> places_;  // by shape: node, or index into added_ with kAdded, or kNone
    std::size_t count_ = 0;

    std::uint32_t takePair();
    void sortAlongCurve();
    void build(std::uint32_t node, std::uint32_t parent, const Leaf* begin, const Leaf* end);
    void collect(std::uint32_t node, bool isRoot);
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
