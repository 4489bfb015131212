// SPDX-License-Identifier: MIT
// Rows of four, as lanes: what several bodies have side by side in memory, turned so that each of the four is
// one Lane, and back.
#pragma once

#include "math/lane.hpp"

#include <utility>

namespace tamias2d::inline TAMIAS_PRECISION {

template <int W>
struct FourLanes {
    Lane<W> x, y, z, w;
};

namespace lane_rows {

template <int W>
using Vector = typename Lane<W>::Vector;

// Within each group of four elements, `first` picks from a and b what `index` says (4 and above are of b).
template <int W, int I0, int I1, int I2, int I3, int... Groups>
TAMIAS_INLINE Vector<W> pickInGroups(Vector<W> a, Vector<W> b, std::integer_sequence<int, Groups...>)
{
    constexpr auto at = [](int element) {
        constexpr int kIndex[4] = {I0, I1, I2, I3};
        const int group = element / 4 * 4, index = kIndex[element % 4];
        return index < 4 ? group + index : W + group + index - 4;
    };
    return __builtin_shufflevector(a, b, at(Groups)...);
}
template <int W, int I0, int I1, int I2, int I3>
TAMIAS_INLINE Vector<W> pick(Vector<W> a, Vector<W> b)
{
    return pickInGroups<W, I0, I1, I2, I3>(a, b, std::make_integer_sequence<int, W>{});
}

// Four vectors of rows to four of components; twice is back again.
template <int W>
TAMIAS_INLINE FourLanes<W> transpose(Vector<W> r0, Vector<W> r1, Vector<W> r2, Vector<W> r3)
{
    const auto xy01 = pick<W, 0, 4, 1, 5>(r0, r1), zw01 = pick<W, 2, 6, 3, 7>(r0, r1);
    const auto xy23 = pick<W, 0, 4, 1, 5>(r2, r3), zw23 = pick<W, 2, 6, 3, 7>(r2, r3);
    return {Lane<W>(pick<W, 0, 1, 4, 5>(xy01, xy23)), Lane<W>(pick<W, 2, 3, 6, 7>(xy01, xy23)),
            Lane<W>(pick<W, 0, 1, 4, 5>(zw01, zw23)), Lane<W>(pick<W, 2, 3, 6, 7>(zw01, zw23))};
}

template <int W, int... I>
TAMIAS_INLINE Vector<2 * W> joined(Vector<W> a, Vector<W> b, std::integer_sequence<int, I...>)
{
    return __builtin_shufflevector(a, b, I...);
}
template <int W, int From, int... I>
TAMIAS_INLINE Vector<W / 2> half(Vector<W> a, std::integer_sequence<int, I...>)
{
    return __builtin_shufflevector(a, a, (From + I)...);
}

// Rows first, first + 4, first + 8 ... one after the other.
template <int W, int Group = 0, int Groups = W / 4>
TAMIAS_INLINE Vector<4 * Groups> loadEveryFourth(const LaneRow* rows, const std::uint32_t* first)
{
    if constexpr (Groups == 1) {
        Vector<4> row;
        __builtin_memcpy(&row, &rows[first[4 * Group]], sizeof row);
        return row;
    } else {
        constexpr int kHalf = Groups / 2;
        return joined<2 * Groups>(loadEveryFourth<W, Group, kHalf>(rows, first),
                                  loadEveryFourth<W, Group + kHalf, kHalf>(rows, first),
                                  std::make_integer_sequence<int, 4 * Groups>{});
    }
}

template <int W, int Group = 0, int Groups = W / 4>
TAMIAS_INLINE void storeEveryFourth(Vector<4 * Groups> values, LaneRow* rows, const std::uint32_t* first,
                                    std::uint32_t written)
{
    if constexpr (Groups == 1) {
        if ((written >> (4 * Group) & 1u) != 0)
            __builtin_memcpy(&rows[first[4 * Group]], &values, sizeof values);
    } else {
        constexpr int kHalf = Groups / 2;
        using Indices = std::make_integer_sequence<int, 2 * Groups>;
        storeEveryFourth<W, Group, kHalf>(half<4 * Groups, 0>(values, Indices{}), rows, first, written);
        storeEveryFourth<W, Group + kHalf, kHalf>(half<4 * Groups, 2 * Groups>(values, Indices{}), rows,
                                                  first, written);
    }
}

}  // namespace lane_rows

/// The rows with the numbers `at`, as lanes.
template <int W>
TAMIAS_INLINE FourLanes<W> gatherRows(const LaneRow* rows, const std::uint32_t (&at)[W])
{
    if constexpr (W >= 4) {
        using lane_rows::loadEveryFourth;
        return lane_rows::transpose<W>(loadEveryFourth<W>(rows, at), loadEveryFourth<W>(rows, at + 1),
                                       loadEveryFourth<W>(rows, at + 2), loadEveryFourth<W>(rows, at + 3));
    } else {
        FourLanes<W> lanes;
        for (int i = 0; i < W; ++i) {
            const LaneRow& row = rows[at[i]];
            lanes.x.v[i] = row.x;
            lanes.y.v[i] = row.y;
            lanes.z.v[i] = row.z;
            lanes.w.v[i] = row.w;
        }
        return lanes;
    }
}

/// Writes the lanes whose bit is set in `written` to the rows with the numbers `at`.
template <int W>
TAMIAS_INLINE void scatterRows(const FourLanes<W>& lanes, LaneRow* rows, const std::uint32_t (&at)[W],
                               std::uint32_t written)
{
    if constexpr (W >= 4) {
        const auto [r0, r1, r2, r3] = lane_rows::transpose<W>(lanes.x.v, lanes.y.v, lanes.z.v, lanes.w.v);
        lane_rows::storeEveryFourth<W>(r0.v, rows, at, written);
        lane_rows::storeEveryFourth<W>(r1.v, rows, at + 1, written >> 1);
        lane_rows::storeEveryFourth<W>(r2.v, rows, at + 2, written >> 2);
        lane_rows::storeEveryFourth<W>(r3.v, rows, at + 3, written >> 3);
    } else {
        for (int i = 0; i < W; ++i) {
            if ((written >> i & 1u) == 0) continue;
            rows[at[i]] = {lanes.x.v[i], lanes.y.v[i], lanes.z.v[i], lanes.w.v[i]};
        }
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
