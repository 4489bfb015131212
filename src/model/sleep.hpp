// SPDX-License-Identifier: MIT
#pragma once

#include "model/contacts.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Bodies that fell asleep together and wake together, with all they carry.
///
/// Invariants: `bodies` rise and are not empty, each has this group as its BodyRow::group and no velocity;
/// each contact has points and at least one of its bodies here, the other here or where nothing pushes it.
struct SleepGroup {
    std::vector<std::uint32_t> bodies;     // slots
    Table<Contact> contacts;         // sorted by shapes; impulses of the last tick awake
    std::vector<std::array<double, 3>> lawForces;   // and torque, by body, when the laws were last asked
    bool lawsWereAsked = false;
    bool isMet = false;                    // by a body of the step that is being gathered

    /// As new, but for the memory, which is kept for the next group.
    void clear()
    {
        bodies.clear();
        contacts.clear();
        lawForces.clear();
        lawsWereAsked = false;
        isMet = false;
    }
};

/// All groups. A free one has no bodies.
struct SleepTable {
    std::vector<SleepGroup> groups;
    std::vector<std::uint32_t> free;       // in no order
    std::uint32_t bodies = 0;              // asleep
    std::uint32_t touching = 0;            // contacts of theirs that touch
    std::uint32_t contacts = 0, mostContacts = 0;   // of theirs: now, and at once, ever

    bool isEmpty() const { return bodies == 0; }
    std::uint32_t take()
    {
        if (free.empty()) {
            groups.emplace_back();
            return static_cast<std::uint32_t>(groups.size() - 1);
        }
        const std::uint32_t group = free.back();
        free.pop_back();
        return group;
    }
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
