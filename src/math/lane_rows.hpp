// SPDX-License-Identifier: MIT
// Rows of four, as lanes: what several bodies have side by side in memory, turned so that each of the four is
// one vector, and back.
#pragma once

#include "math/lane.hpp"

#include <cstddef>
#include <utility>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Groups of four numbers in memory, one for each lane, that stand anywhere: `first` is that of row 0,
/// `stride` the bytes from row to row. Byte is const where they are only read.
template <class Byte>
struct ScatteredRows {
    Byte* first;
    std::size_t stride;
    const std::uint32_t* rows;  // by lane

    TAMIAS_INLINE Byte* at(int lane) const { return first + rows[lane] * stride; }
};

/// The same for rows that follow each other.
template <class Byte, std::size_t Stride>
struct ConsecutiveRows {
    Byte* first;  // of lane 0

    TAMIAS_INLINE Byte* at(int lane) const { return first + static_cast<std::size_t>(lane) * Stride; }
};

/// The same where each lane has a pointer to its row.
struct PointedRows {
    const real* const* rows;
    int first;  // number in the row

    TAMIAS_INLINE const real* at(int lane) const { return rows[lane] + first; }
};

namespace lane_rows {

template <class T, int W>
using Vector = typename VectorOf<T, W* int{sizeof(T)}>::Type;

template <class T, int W>
struct Four {
    Vector<T, W> x, y, z, w;
};

// Within each group of four elements, `first` picks from a and b what `index` says (4 and above are of b).
template <class T, int W, int I0, int I1, int I2, int I3, int... Groups>
TAMIAS_INLINE Vector<T, W> pickInGroups(Vector<T, W> a, Vector<T, W> b, std::integer_sequence<int, Groups...>)
{
    constexpr auto at = [](int element) {
        constexpr int kIndex[4] = {I0, I1, I2, I3};
        const int group = element / 4 * 4, index = kIndex[element % 4];
        return index < 4 ? group + index : W + group + index - 4;
    };
    return __builtin_shufflevector(a, b, at(Groups)...);
}
template <class T, int W, int I0, int I1, int I2, int I3>
TAMIAS_INLINE Vector<T, W> pick(Vector<T, W> a, Vector<T, W> b)
{
    return pickInGroups<T, W, I0, I1, I2, I3>(a, b, std::make_integer_sequence<int, W>{});
}

// Four vectors of rows to four of components; twice is back again.
template <class T, int W>
TAMIAS_INLINE Four<T, W> transpose(Vector<T, W> r0, Vector<T, W> r1, Vector<T, W> r2, Vector<T, W> r3)
{
    const auto xy01 = pick<T, W, 0, 4, 1, 5>(r0, r1), zw01 = pick<T, W, 2, 6, 3, 7>(r0, r1);
    const auto xy23 = pick<T, W, 0, 4, 1, 5>(r2, r3), zw23 = pick<T, W, 2, 6, 3, 7>(r2, r3);
    return {pick<T, W, 0, 1, 4, 5>(xy01, xy23), pick<T, W, 2, 3, 6, 7>(xy01, xy23),
            pick<T, W, 0, 1, 4, 5>(zw01, zw23), pick<T, W, 2, 3, 6, 7>(zw01, zw23)};
}

template <class T, int W, int... I>
TAMIAS_INLINE Vector<T, 2 * W> joined(Vector<T, W> a, Vector<T, W> b, std::integer_sequence<int, I...>)
{
    return __builtin_shufflevector(a, b, I...);
}
template <class T, int W, int From, int... I>
TAMIAS_INLINE Vector<T, W / 2> half(Vector<T, W> a, std::integer_sequence<int, I...>)
{
    return __builtin_shufflevector(a, a, (From + I)...);
}

// Rows first, first + 4, first + 8 ... one after the other.
template <class T, int W, int Group = 0, int Groups = W / 4, class Rows>
TAMIAS_INLINE Vector<T, 4 * Groups> loadEveryFourth(const Rows& rows, int first)
{
    if constexpr (Groups == 1) {
        Vector<T, 4> row;
        __builtin_memcpy(&row, rows.at(first + 4 * Group), sizeof row);
        return row;
    } else {
        constexpr int kHalf = Groups / 2;
        return joined<T, 2 * Groups>(loadEveryFourth<T, W, Group, kHalf>(rows, first),
                                     loadEveryFourth<T, W, Group + kHalf, kHalf>(rows, first),
                                     std::make_integer_sequence<int, 4 * Groups>{});
    }
}

template <class T, int W, int Group = 0, int Groups = W / 4, class Rows>
TAMIAS_INLINE void storeEveryFourth(Vector<T, 4 * Groups> values, const Rows& rows, int first,
                                    std::uint32_t written)
{
    if constexpr (Groups == 1) {
        if ((written >> (first + 4 * Group) & 1u) != 0)
            __builtin_memcpy(rows.at(first + 4 * Group), &values, sizeof values);
    } else {
        constexpr int kHalf = Groups / 2;
        using Indices = std::make_integer_sequence<int, 2 * Groups>;
        storeEveryFourth<T, W, Group, kHalf>(half<T, 4 * Groups, 0>(values, Indices{}), rows, first, written);
        storeEveryFourth<T, W, Group + kHalf, kHalf>(half<T, 4 * Groups, 2 * Groups>(values, Indices{}), rows,
                                                     first, written);
    }
}

// Of lanes `first` to `first` + W - 1.
template <class T, int W, class Rows>
TAMIAS_INLINE Four<T, W> gather(const Rows& rows, int first)
{
    if constexpr (W >= 4) {
        return transpose<T, W>(loadEveryFourth<T, W>(rows, first), loadEveryFourth<T, W>(rows, first + 1),
                               loadEveryFourth<T, W>(rows, first + 2),
                               loadEveryFourth<T, W>(rows, first + 3));
    } else {
        static_assert(W == 2);
        Vector<T, 2> row[2][2];
        for (int i = 0; i < 2; ++i) __builtin_memcpy(row[i], rows.at(first + i), sizeof row[i]);
        return {__builtin_shufflevector(row[0][0], row[1][0], 0, 2),
                __builtin_shufflevector(row[0][0], row[1][0], 1, 3),
                __builtin_shufflevector(row[0][1], row[1][1], 0, 2),
                __builtin_shufflevector(row[0][1], row[1][1], 1, 3)};
    }
}

template <class T, int W, class Rows>
TAMIAS_INLINE void scatter(const Four<T, W>& v, const Rows& rows, int first, std::uint32_t written)
{
    if constexpr (W >= 4) {
        const auto [r0, r1, r2, r3] = transpose<T, W>(v.x, v.y, v.z, v.w);
        storeEveryFourth<T, W>(r0, rows, first, written);
        storeEveryFourth<T, W>(r1, rows, first + 1, written);
        storeEveryFourth<T, W>(r2, rows, first + 2, written);
        storeEveryFourth<T, W>(r3, rows, first + 3, written);
    } else {
        static_assert(W == 2);
        const Vector<T, 2> row[2][2] = {
            {__builtin_shufflevector(v.x, v.y, 0, 2), __builtin_shufflevector(v.z, v.w, 0, 2)},
            {__builtin_shufflevector(v.x, v.y, 1, 3), __builtin_shufflevector(v.z, v.w, 1, 3)}};
        for (int i = 0; i < 2; ++i)
            if ((written >> (first + i) & 1u) != 0)
                __builtin_memcpy(rows.at(first + i), row[i], sizeof row[i]);
    }
}

}  // namespace lane_rows

template <int W>
struct FourLanes {
    Lane<W> x, y, z, w;
};

/// One row for each lane, as lanes.
template <int W, class Rows>
TAMIAS_INLINE FourLanes<W> gatherRows(const Rows& rows)
{
    if constexpr (W == 1) {
        LaneRow row;
        __builtin_memcpy(&row, rows.at(0), sizeof row);
        return {row.x, row.y, row.z, row.w};
    } else {
        const auto four = lane_rows::gather<real, W>(rows, 0);
        return {Lane<W>(four.x), Lane<W>(four.y), Lane<W>(four.z), Lane<W>(four.w)};
    }
}
/// Writes the lanes whose bit is set in `written`.
template <int W, class Rows>
TAMIAS_INLINE void scatterRows(const FourLanes<W>& lanes, const Rows& rows, std::uint32_t written)
{
    if constexpr (W == 1) {
        const LaneRow row{lanes.x.v[0], lanes.y.v[0], lanes.z.v[0], lanes.w.v[0]};
        if ((written & 1u) != 0) __builtin_memcpy(rows.at(0), &row, sizeof row);
    } else {
        constexpr std::uint32_t kAll = (std::uint64_t{1} << W) - 1;
        const lane_rows::Four<real, W> four{lanes.x.v, lanes.y.v, lanes.z.v, lanes.w.v};
        if ((written & kAll) == kAll)  // mostly, and asks nothing lane by lane
            lane_rows::scatter<real, W>(four, rows, 0, kAll);
        else
            lane_rows::scatter<real, W>(four, rows, 0, written);
    }
}

/// The rows with the numbers `at`.
template <int W>
TAMIAS_INLINE FourLanes<W> gatherRows(const LaneRow* rows, const std::uint32_t (&at)[W])
{
    const auto* const first = reinterpret_cast<const std::byte*>(rows);
    return gatherRows<W>(ScatteredRows<const std::byte>{first, sizeof(LaneRow), at});
}
template <int W>
TAMIAS_INLINE void scatterRows(const FourLanes<W>& lanes, LaneRow* rows, const std::uint32_t (&at)[W],
                               std::uint32_t written)
{
    auto* const first = reinterpret_cast<std::byte*>(rows);
    scatterRows<W>(lanes, ScatteredRows<std::byte>{first, sizeof(LaneRow), at}, written);
}

/// The first N reals behind each of W pointers, as N lanes.
template <int N, int W>
TAMIAS_INLINE void loadColumns(const real* const (&rows)[W], Lane<W>* columns)
{
    static_assert(N % 4 == 0);
    for (int i = 0; i < N; i += 4) {
        const FourLanes<W> four = gatherRows<W>(PointedRows{rows, i});
        columns[i] = four.x, columns[i + 1] = four.y, columns[i + 2] = four.z, columns[i + 3] = four.w;
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
