// SPDX-License-Identifier: MIT
#pragma once

#include "islands/links.hpp"
#include "model/motion.hpp"
#include "solver/tick_rows.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Which large islands have nearly come to rest: docs/theory/calm.md, section 4. The memory is kept.
class SettlingIslands {
public:
    static constexpr std::uint32_t kLarge = 100;  ///< bodies

    /// For as many rows.
    void reserve(std::size_t rows)
    {
        largeOf_.reserve(rows);
        large_.reserve(rows / kLarge + 1);
    }
    /// Finds those whose kinetic energy is less than if all their bodies went at `slow` [m/s]: against the
    /// ground that they stand on, or against their own center if they stand on nothing.
    void find(const Islands& islands, const Table<Motion>& rows, const Table<LaneRow>& velocities, real slow);
    bool holds(std::uint32_t island) const
    {
        return largeOf_[island] != Islands::kNone && large_[largeOf_[island]].settles;
    }

private:
    // Mass, momentum and twice the kinetic energy of an island, against its ground if it has one.
    struct Large {
        std::uint32_t island;
        bool settles = false;
        double mass = 0, energy = 0;
        DVec2 momentum = {};
    };
    std::vector<std::uint32_t> largeOf_;  // by island; kNone for a small one
    std::vector<Large> large_;

    void add(const Motion& m, BodyMotion<real> motion, Large& island) const;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
