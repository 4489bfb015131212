// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <cstddef>
#include <type_traits>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Room for N objects, each of which is written before it is read: making them all first would cost more than
/// what is done with them.
template <class T, std::size_t N>
class Room {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

public:
    Room() noexcept {}
    T* data() { return objects_; }
    const T* data() const { return objects_; }
    T& operator[](std::size_t i) { return objects_[i]; }
    const T& operator[](std::size_t i) const { return objects_[i]; }

private:
    union {
        T objects_[N];
    };
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
