// SPDX-License-Identifier: MIT
#pragma once

#include "base/memory.hpp"
#include "broadphase/float_box.hpp"

#include <tamias2d/math/vec2.hpp>

#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Where there is none of what does not move, as of so many changes of that: who stays in there need not ask.
struct ClearRoom {
    FloatBox box{1, 1, -1, -1};
    std::uint32_t of = 0;
};

/// The boxes of what does not move, for questions of those that do: a few balanced trees. What is added
/// becomes a tree of its own, together with all trees that are not larger than twice the sum so far; so there
/// are never more than a logarithm of them, whatever comes in whatever order, and what rests costs nothing.
/// What is removed leaves its tree, which never grows deeper.
class RestTrees {
public:
    explicit RestTrees(MemorySource memory = nullptr)
        : nodes_(sourceOr(memory)), freePairs_(sourceOr(memory)), trees_(sourceOr(memory)),
          added_(sourceOr(memory)), places_(sourceOr(memory))
    {
    }
    /// Adds a shape that is not here. It is found from the next settle() on.
    void add(std::uint32_t shape, const Aabb& box);
    /// Removes a shape, if it is here.
    void remove(std::uint32_t shape);
    bool holds(std::uint32_t shape) const { return shape < places_.size() && places_[shape] != kNone; }
    std::size_t size() const { return count_; }
    std::size_t places() const { return places_.size(); }  ///< shapes that there is a place for
    /// A number that changes whenever a shape is added or removed.
    std::uint64_t changes() const { return changes_; }
    /// Builds a tree of what was added.
    void settle();

    /// Calls visit(shape) for every shape whose box, rounded outwards, overlaps `box`; in no order that means
    /// anything.
    template <class Visit>
    void eachOverlapping(const Aabb& box, Visit visit) const
    {
        const FloatBox wanted = FloatBox::of(box);
        each([&wanted](const FloatBox& b) { return overlaps(b, wanted); }, visit);
    }

    /// Is there such a shape at all?
    bool anyOverlapping(const Aabb& box) const
    {
        bool any = false;
        const FloatBox wanted = FloatBox::of(box);
        each([&](const FloatBox& b) { return !any && overlaps(b, wanted); },
             [&any](std::uint32_t) { any = true; });
        return any;
    }

    /// The same as eachOverlapping for the boxes that the segment from `from` to `to` meets, and perhaps a
    /// few more.
    template <class Visit>
    void eachAlong(Position from, Position to, Visit visit) const
    {
        const FloatBox bounds = FloatBox::of(
            {{minimum(from.x, to.x), minimum(from.y, to.y)}, {maximum(from.x, to.x), maximum(from.y, to.y)}});
        const DVec2 way = to - from;
        const double wide = absolute(way.y), high = absolute(way.x);
        each(
            [&](const FloatBox& b) {
                if (!overlaps(b, bounds)) return false;
                const double left = b.left, right = b.right, bottom = b.bottom, top = b.top;
                const DVec2 center{left / 2 + right / 2 - from.x, bottom / 2 + top / 2 - from.y};
                const double reach = (right / 2 - left / 2) * wide + (top / 2 - bottom / 2) * high;
                return absolute(cross(way, center)) <= 1.0001 * reach;
            },
            visit);
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

    Column<Node> nodes_;  // in pairs; the first of a pair is even
    Column<std::uint32_t> freePairs_;
    Column<Tree> trees_;
    Column<Leaf> added_;  // not in a tree yet
    Column<std::uint32_t> places_;  // by shape: node, or index into added_ with kAdded, or kNone
    std::size_t count_ = 0;
    std::uint64_t changes_ = 0;

    template <class Meets, class Visit>
    void each(Meets meets, Visit visit) const
    {
        std::uint32_t stack[kDeepest];
        for (const Tree& tree : trees_) {
            std::uint32_t depth = 0;
            stack[depth++] = tree.root;
            while (depth > 0) {
                const Node& node = nodes_[stack[--depth]];
                if (!meets(node.box)) continue;
                if (node.isLeaf()) {
                    visit(node.child);
                } else {
                    stack[depth++] = node.child + 1;
                    stack[depth++] = node.child;
                }
            }
        }
    }

    std::uint32_t takePair();
    void sortAlongCurve();
    void build(std::uint32_t node, std::uint32_t parent, const Leaf* begin, const Leaf* end);
    void collect(std::uint32_t node, bool isRoot);
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
