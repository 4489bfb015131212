// SPDX-License-Identifier: MIT
// Is what an id names alive in this world?
#pragma once

#include "base/check.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// As it stands in complaints.
template <class IdType>
std::string textOfId(const IdType& id)
{
    return id.isNull() ? "null" : textOf(id.index) + " (generation " + textOf(id.generation) + ")";
}

template <class IdType>
Complaint checkAlive(std::string_view field, bool alive, const IdType& id, std::string_view what)
{
    if (alive) return std::nullopt;
    return InputError(std::string(field), textOfId(id),
                      "must be a live " + std::string(what) + " of this world");
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
