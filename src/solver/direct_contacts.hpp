// SPDX-License-Identifier: MIT
// Contacts as rows of a group that is solved at once: docs/theory/joints.md, section 8.
#pragma once

#include "joints/rows.hpp"
#include "model/contacts.hpp"

#include <tamias2d/model/clamps.hpp>

#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The normals of the points that the passes settle, their frictions, rolling. Adds to `places` which of the
/// contact's impulses each row is of.
JointRows directRowsOf(const Contact& c, const Motion& a, const Motion& b, const StepContext& context,
                       std::vector<std::uint8_t>& places);

/// The impulses of those rows, back in the contact; `place` goes on by as many.
void storeDirectRows(const JointRows& rows, const std::uint8_t*& place, Contact& c);

/// The normals alone, asked to undo overlaps; says in `any` whether there is one.
JointRows pushRowsOf(const Contact& c, const Motion& a, const Motion& b, const StepContext& context,
                     ClampCounts& clamps, bool& any);

}  // namespace tamias2d::inline TAMIAS_PRECISION
