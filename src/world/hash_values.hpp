// SPDX-License-Identifier: MIT
// Places, flags and texts in a hash.
#pragma once

#include "base/hash.hpp"

#include <tamias2d/math/transform.hpp>
#include <tamias2d/math/vec2.hpp>

#include <cstdint>
#include <string>

namespace tamias2d::inline TAMIAS_PRECISION {

inline void add(Hasher& hash, Vec2 v)
{
    hash.add(v.x);
    hash.add(v.y);
}

inline void add(Hasher& hash, Position p)
{
    hash.add(p.x);
    hash.add(p.y);
}

template <class... Flags>
void addFlags(Hasher& hash, Flags... flags)
{
    std::uint64_t bits = 1;
    ((bits = bits << 8 | static_cast<std::uint64_t>(flags)), ...);
    hash.add(bits);
}

inline void add(Hasher& hash, const std::string& text)
{
    hash.add(std::uint64_t{text.size()});
    for (const char c : text) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
