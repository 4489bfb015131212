// SPDX-License-Identifier: MIT
#pragma once

#include <support/overlap.hpp>
#include <tamias2d/tamias2d.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace tamias2d::test {

/// Looks at all poses in every sub-step: a force law without force, which the world must ask there.
/// Keeps the deepest overlap of any two bodies, relative to the size of the smaller, and counts the looks.
///
/// Bodies have one shape and their origin at their center of mass; static ones count as immovable.
class SubstepProbe {
public:
    explicit SubstepProbe(World& world)
    {
        for (const BodyId id : world.bodies()) {
            const Body body = world.body(id);
            Seen seen;
            seen.local = outlineOf(body.shapes()[0].definition().geometry);
            seen.id = id;
            seen.moves = body.type() == BodyType::Dynamic;
            seen.size = seen.moves ? smallestWidth(seen.local) : std::numeric_limits<double>::infinity();
            place(seen.local, body.position() - Position{}, body.angle(), seen.now);
            if (slots_.size() <= id.index) slots_.resize(id.index + 1);
            slots_[id.index] = seen_.size();
            seen_.push_back(seen);
        }
        ForceLaw law;
        law.force = [this](const BodyView& body, double t) {
            look(body, t);
            return Wrench{};
        };
        law_ = world.addForceLaw(law);
    }

    std::uint64_t looks() const { return looks_; }
    double deepest() const { return deepest_; }              ///< [m]
    double deepestOfSize() const { return deepestOfSize_; }  ///< over the smaller width   [1]
    double deepestTime() const { return deepestTime_; }      ///< when that was            [s]
    std::pair<BodyId, BodyId> deepestPair() const { return deepestPair_; }

private:
    struct Seen {
        BodyId id;
        Outline local, now;
        double size = 0;
        bool moves = false;
    };

    static double smallestWidth(const Outline& o)
    {
        double width = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; o.core.size() > 1 && i < o.core.size(); ++i) {
            const DVec2 edge = o.core[(i + 1) % o.core.size()] - o.core[i];
            double across = 0;
            for (const DVec2 p : o.core) across = std::max(across, cross(edge, p - o.core[i]) / length(edge));
            width = std::min(width, across);
        }
        return (o.core.size() == 1 ? 0 : width) + 2 * o.radius;
    }

    // A new time means that every body has been seen at the one before.
    void look(const BodyView& body, double t)
    {
        if (t != time_) {
            if (time_ >= 0) measure();
            time_ = t;
        }
        Seen& seen = seen_[slots_[body.id.index]];
        place(seen.local, body.center - Position{}, body.angle, seen.now);
    }

    void measure()
    {
        ++looks_;
        order_.resize(seen_.size());
        for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = i;
        const auto left = [&](std::size_t i) { return seen_[i].now.center.x - seen_[i].now.reach; };
        std::sort(order_.begin(), order_.end(),
                  [&](std::size_t a, std::size_t b) { return left(a) < left(b); });
        for (std::size_t i = 0; i < order_.size(); ++i) {
            const Seen& a = seen_[order_[i]];
            const double right = a.now.center.x + a.now.reach;
            for (std::size_t k = i + 1; k < order_.size() && left(order_[k]) < right; ++k)
                compare(a, seen_[order_[k]]);
        }
    }

    void compare(const Seen& a, const Seen& b)
    {
        if (!a.moves && !b.moves) return;
        const double reach = a.now.reach + b.now.reach;
        const DVec2 apart = a.now.center - b.now.center;
        if (dot(apart, apart) > reach * reach) return;
        const double overlap = -gapBetween(a.now, b.now);
        deepest_ = std::max(deepest_, overlap);
        const double ofSize = overlap / std::min(a.size, b.size);
        if (ofSize <= deepestOfSize_) return;
        deepestOfSize_ = ofSize;
        deepestTime_ = time_;
        deepestPair_ = {a.id, b.id};
    }

    std::vector<std::size_t> slots_;  // by index of the body id
    std::vector<Seen> seen_;
    std::vector<std::size_t> order_;
    ForceLawId law_;
    double time_ = -1;
    std::uint64_t looks_ = 0;
    double deepest_ = 0;
    double deepestOfSize_ = 0;
    double deepestTime_ = 0;
    std::pair<BodyId, BodyId> deepestPair_;
};

}  // namespace tamias2d::test
