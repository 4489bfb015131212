// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <cstddef>
#include <memory_resource>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Where tables take their memory from: a source that a caller has given, or new and delete.
using MemorySource = std::pmr::memory_resource*;

/// New and delete; large tables in huge pages, see pages.hpp.
MemorySource pageSource();

inline MemorySource sourceOr(MemorySource given)
{
    return given != nullptr ? given : pageSource();
}

/// A column of a table.
template <class Row>
using Column = std::pmr::vector<Row>;

/// Of memory held, but for what rows own themselves.
template <class Vector>
std::size_t bytesOf(const Vector& v)
{
    return v.capacity() * sizeof(typename Vector::value_type);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
