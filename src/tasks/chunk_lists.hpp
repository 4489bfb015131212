// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What the chunks of a loop find, a list each. All lists have room for as much as any has ever held, so that
/// no memory is needed once warm, wherever there happens to be much.
template <class T>
class ChunkLists {
public:
    /// Empties them; to be called before each loop.
    void begin(std::size_t chunks)
    {
        for (const std::vector<T>& list : lists_) most_ = std::max(most_, list.size());
        if (lists_.size() < chunks) lists_.resize(chunks);
        const std::size_t room = most_ == 0 ? 0 : std::bit_ceil(2 * most_);
        for (std::size_t k = 0; k < lists_.size(); ++k) {
            lists_[k].clear();
            if (k < chunks) lists_[k].reserve(room);
        }
        chunks_ = chunks;
    }
    std::vector<T>& of(std::size_t chunk) { return lists_[chunk]; }
    /// Calls body(item) for all, in the order of the chunks.
    template <class Body>
    void forAll(Body body) const
    {
        for (std::size_t k = 0; k < chunks_; ++k)
            for (const T& item : lists_[k]) body(item);
    }

private:
    std::vector<std::vector<T>> lists_;
    std::size_t chunks_ = 0;
    std::size_t most_ = 0;  // that a list has held
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
