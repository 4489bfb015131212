// SPDX-License-Identifier: MIT
#pragma once

#include "model/motion.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// Where a body was when something was found out that holds as long as it stays near there.
struct ReferencePose {
    Position center;              // [m]
    double angle = 0;             // in [0, 2 pi)   [rad]
    real room = -1;               // how far any of its points may go from there; < 0: nothing holds   [m]

    /// Does it stay near enough, if none of its points goes farther than `travel` [m] from where it is?
    bool holds(const Motion& m, real travel) const
    {
        if (!(travel <= room)) return false;
        const double off = absolute(m.center.x - center.x) + absolute(m.center.y - center.y) +
                           static_cast<double>(m.extent) * turnBetween(m.angle, angle) +
                           static_cast<double>(travel);
        return off <= static_cast<double>(room);
    }
    void renew(const Motion& m, real newRoom)
    {
        center = m.center;
        angle = m.angle;
        room = newRoom;
    }

    /// The smaller turn from one angle in [0, 2 pi) to another.   [rad]
    static double turnBetween(double a, double b)
    {
        const double turn = absolute(a - b);
        return minimum(turn, kTwoPi - turn);
    }
};

/// How a body was turned when something was found out that holds as long as it hardly turns.
struct ReferenceTurn {
    double angle = 0;             // in [0, 2 pi)   [rad]
    real room = -1;               // how far turning may take any of its points; < 0: nothing holds   [m]
    std::uint32_t version = 0;    // another one with each new angle; 0: there has been none yet

    /// Does it, if turning takes none of its points farther than `travel` [m] from where it is?
    bool holds(const Motion& m, real travel) const
    {
        const double turned = static_cast<double>(m.extent) * ReferencePose::turnBetween(m.angle, angle);
        return turned + static_cast<double>(travel) <= static_cast<double>(room);
    }
    void renew(const Motion& m, real newRoom)
    {
        angle = m.angle;
        room = newRoom;
        ++version;
    }
};

/// What is kept from step to step of bodies that hardly move: their boxes of the broad phase; and of those
/// that hardly turn the manifolds with what moves along with them.
struct ReferencePoses {
    struct Row {
        ReferencePose ofBoxes;
        ReferenceTurn ofManifolds;
        real width = 0;   // of its narrowest shape, since the turn that manifolds are kept for   [m]
    };
    Table<Row> rows;   // by number of the MoverRow: what has none has never been in a step

    /// Something else about the body has changed: nothing is kept.
    void forget(std::uint32_t mover)
    {
        if (mover < rows.size()) rows[mover].ofBoxes.room = rows[mover].ofManifolds.room = -1;
    }
    void forgetAll()
    {
        for (Row& row : rows) row.ofBoxes.room = row.ofManifolds.room = -1;
    }
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
