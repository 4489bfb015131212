// SPDX-License-Identifier: MIT
// Doubles beside lanes of reals: positions and angles keep their digits in kernels of float, too.
#pragma once

#include "math/lane_rows.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// How many of W doubles stand in one vector, and how many vectors that makes.
template <int W>
inline constexpr int kDoubleVectors = W == 1 || sizeof(real) == sizeof(double) ? 1 : 2;

/// W truths about doubles, one a lane.
template <int W>
struct DoubleMask {
    static constexpr int kVectors = kDoubleVectors<W>, kWidth = W / kVectors;
    using Vector = typename VectorOf<std::int64_t, kWidth* int{sizeof(std::int64_t)}>::Type;
    Vector v[kVectors];  // 0 or -1 each

    friend DoubleMask operator&(DoubleMask a, DoubleMask b)
    {
        for (int i = 0; i < kVectors; ++i) a.v[i] &= b.v[i];
        return a;
    }
    friend DoubleMask operator|(DoubleMask a, DoubleMask b)
    {
        for (int i = 0; i < kVectors; ++i) a.v[i] |= b.v[i];
        return a;
    }
    friend DoubleMask operator!(DoubleMask a)
    {
        for (int i = 0; i < kVectors; ++i) a.v[i] = ~a.v[i];
        return a;
    }
};

/// W doubles that are reckoned with at once, as Lane<W> are: the same bits as `double` has.
template <int W>
struct DoubleLane {
    static constexpr int kVectors = kDoubleVectors<W>, kWidth = W / kVectors;
    using Vector = typename VectorOf<double, kWidth* int{sizeof(double)}>::Type;
    using Mask = DoubleMask<W>;
    Vector v[kVectors];

    DoubleLane() : v{} {}
    DoubleLane(double all)
    {
        for (Vector& part : v) part = all - Vector{};
    }

    DoubleLane& operator+=(DoubleLane b)
    {
        for (int i = 0; i < kVectors; ++i) v[i] += b.v[i];
        return *this;
    }
    DoubleLane& operator-=(DoubleLane b)
    {
        for (int i = 0; i < kVectors; ++i) v[i] -= b.v[i];
        return *this;
    }
    DoubleLane& operator*=(DoubleLane b)
    {
        for (int i = 0; i < kVectors; ++i) v[i] *= b.v[i];
        return *this;
    }
    friend DoubleLane operator+(DoubleLane a, DoubleLane b) { return a += b; }
    friend DoubleLane operator-(DoubleLane a, DoubleLane b) { return a -= b; }
    friend DoubleLane operator*(DoubleLane a, DoubleLane b) { return a *= b; }
    friend DoubleLane operator/(DoubleLane a, DoubleLane b)
    {
        for (int i = 0; i < kVectors; ++i) a.v[i] /= b.v[i];
        return a;
    }
    friend DoubleLane operator-(DoubleLane a)
    {
        for (int i = 0; i < kVectors; ++i) a.v[i] = -a.v[i];
        return a;
    }

    friend Mask operator<(DoubleLane a, DoubleLane b)
    {
        Mask mask;
        for (int i = 0; i < kVectors; ++i) mask.v[i] = a.v[i] < b.v[i];
        return mask;
    }
    friend Mask operator>(DoubleLane a, DoubleLane b) { return b < a; }
    friend Mask operator>=(DoubleLane a, DoubleLane b)
    {
        Mask mask;
        for (int i = 0; i < kVectors; ++i) mask.v[i] = a.v[i] >= b.v[i];
        return mask;
    }
    friend Mask isEqual(DoubleLane a, DoubleLane b)
    {
        Mask mask;
        for (int i = 0; i < kVectors; ++i) mask.v[i] = a.v[i] == b.v[i];
        return mask;
    }
};

/// One lane is one number, as it is of reals.
template <>
struct DoubleMask<1> {
    bool v;

    friend DoubleMask operator&(DoubleMask a, DoubleMask b) { return {a.v && b.v}; }
    friend DoubleMask operator|(DoubleMask a, DoubleMask b) { return {a.v || b.v}; }
    friend DoubleMask operator!(DoubleMask a) { return {!a.v}; }
};
template <>
struct DoubleLane<1> {
    using Mask = DoubleMask<1>;
    double v;

    DoubleLane(double all = 0) : v(all) {}

    DoubleLane& operator+=(DoubleLane b) { return v += b.v, *this; }
    DoubleLane& operator-=(DoubleLane b) { return v -= b.v, *this; }
    DoubleLane& operator*=(DoubleLane b) { return v *= b.v, *this; }
    friend DoubleLane operator+(DoubleLane a, DoubleLane b) { return a.v + b.v; }
    friend DoubleLane operator-(DoubleLane a, DoubleLane b) { return a.v - b.v; }
    friend DoubleLane operator*(DoubleLane a, DoubleLane b) { return a.v * b.v; }
    friend DoubleLane operator/(DoubleLane a, DoubleLane b) { return a.v / b.v; }
    friend DoubleLane operator-(DoubleLane a) { return -a.v; }
    friend Mask operator<(DoubleLane a, DoubleLane b) { return {a.v < b.v}; }
    friend Mask operator>(DoubleLane a, DoubleLane b) { return {a.v > b.v}; }
    friend Mask operator>=(DoubleLane a, DoubleLane b) { return {a.v >= b.v}; }
    friend Mask isEqual(DoubleLane a, DoubleLane b) { return {a.v == b.v}; }
};

template <int W>
DoubleLane<W> select(DoubleMask<W> condition, DoubleLane<W> a, DoubleLane<W> b)
{
    if constexpr (W == 1) {
        return condition.v ? a : b;
    } else {
        for (int i = 0; i < DoubleLane<W>::kVectors; ++i) a.v[i] = condition.v[i] ? a.v[i] : b.v[i];
        return a;
    }
}

namespace double_lanes {

// The Part-th half of a vector, with elements of another type.
template <class To, int Part, class From, int... I>
TAMIAS_INLINE To convertedHalf(From a, std::integer_sequence<int, I...>)
{
    constexpr int kFirst = Part * int{sizeof...(I)};
    return __builtin_convertvector(__builtin_shufflevector(a, a, (kFirst + I)...), To);
}
template <class To, class From, int... I>
TAMIAS_INLINE To joined(From a, From b, std::integer_sequence<int, I...>)
{
    return __builtin_shufflevector(a, b, I...);
}

// The elements of a vector, as those of the one or two vectors of `Wide`.
template <class Wide, int W, class From>
TAMIAS_INLINE Wide widened(From a)
{
    using Vector = typename Wide::Vector;
    Wide wide;
    if constexpr (Wide::kVectors == 1) {
        wide.v[0] = __builtin_convertvector(a, Vector);
    } else {
        using Half = std::make_integer_sequence<int, W / 2>;
        wide.v[0] = convertedHalf<Vector, 0>(a, Half{});
        wide.v[1] = convertedHalf<Vector, 1>(a, Half{});
    }
    return wide;
}
// And back; `Element` is that of `Vector`.
template <class Vector, class Element, int W, class Wide>
TAMIAS_INLINE Vector narrowed(const Wide& a)
{
    if constexpr (Wide::kVectors == 1) {
        return __builtin_convertvector(a.v[0], Vector);
    } else {
        using Half = typename VectorOf<Element, W* int{sizeof(Element)} / 2>::Type;
        return joined<Vector>(__builtin_convertvector(a.v[0], Half), __builtin_convertvector(a.v[1], Half),
                              std::make_integer_sequence<int, W>{});
    }
}

}  // namespace double_lanes

/// Lanes of reals as doubles, and the reverse; likewise what is true of them.
template <int W>
DoubleLane<W> toDouble(Lane<W> a)
{
    if constexpr (W == 1)
        return static_cast<double>(a.v[0]);
    else
        return double_lanes::widened<DoubleLane<W>, W>(a.v);
}
template <int W>
Lane<W> toReal(DoubleLane<W> a)
{
    if constexpr (W == 1)
        return Lane<1>(static_cast<real>(a.v));
    else
        return Lane<W>(double_lanes::narrowed<typename Lane<W>::Vector, real, W>(a));
}
template <int W>
DoubleMask<W> toDouble(LaneMask<W> a)
{
    if constexpr (W == 1)
        return {a.v[0] != 0};
    else
        return double_lanes::widened<DoubleMask<W>, W>(a.v);
}
template <int W>
LaneMask<W> toReal(DoubleMask<W> a)
{
    using Mask = LaneMask<W>;
    if constexpr (W == 1)
        return {{a.v ? -1 : 0}};
    else
        return {double_lanes::narrowed<typename Mask::Vector, typename Mask::Integer, W>(a)};
}

template <int W>
TAMIAS_INLINE bool any(DoubleMask<W> mask)
{
    return any(toReal(mask));
}

/// Four doubles of each of W rows.
template <int W>
struct FourDoubles {
    DoubleLane<W> x, y, z, w;
};

template <int W, class Rows>
TAMIAS_INLINE FourDoubles<W> gatherDoubles(const Rows& rows)
{
    if constexpr (W == 1) {
        RowOf<double> row;
        __builtin_memcpy(&row, rows.at(0), sizeof row);
        return {row.x, row.y, row.z, row.w};
    } else {
        FourDoubles<W> four;
        constexpr int kWidth = DoubleLane<W>::kWidth;
        for (int i = 0; i < DoubleLane<W>::kVectors; ++i) {
            const auto part = lane_rows::gather<double, kWidth>(rows, i * kWidth);
            four.x.v[i] = part.x, four.y.v[i] = part.y, four.z.v[i] = part.z, four.w.v[i] = part.w;
        }
        return four;
    }
}

template <int W, class Rows>
TAMIAS_INLINE void scatterDoubles(const FourDoubles<W>& four, const Rows& rows)
{
    if constexpr (W == 1) {
        const RowOf<double> row{four.x.v, four.y.v, four.z.v, four.w.v};
        __builtin_memcpy(rows.at(0), &row, sizeof row);
    } else {
        constexpr int kWidth = DoubleLane<W>::kWidth;
        for (int i = 0; i < DoubleLane<W>::kVectors; ++i)
            lane_rows::scatter<double, kWidth>({four.x.v[i], four.y.v[i], four.z.v[i], four.w.v[i]}, rows,
                                               i * kWidth, ~0u);
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
