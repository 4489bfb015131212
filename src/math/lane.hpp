// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/math/vec2.hpp>

#include <cmath>
#include <cstdint>
#include <type_traits>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

/// For kernels: what is inline in them leaves no function behind that could be called from code for another
/// instruction set, and keeps lanes in registers.
#define TAMIAS_INLINE [[gnu::always_inline]] inline

namespace tamias2d::inline TAMIAS_PRECISION {

// The compiler's vectors, by their bytes: g++ 12 forgets a vector_size that depends on a template's
// parameter.
template <class T, int Bytes>
struct VectorOf;
template <class T>
struct VectorOf<T, 8> {
    typedef T Type __attribute__((vector_size(8)));
};
template <class T>
struct VectorOf<T, 16> {
    typedef T Type __attribute__((vector_size(16)));
};
template <class T>
struct VectorOf<T, 32> {
    typedef T Type __attribute__((vector_size(32)));
};
template <class T>
struct VectorOf<T, 64> {
    typedef T Type __attribute__((vector_size(64)));
};

/// W truths, one a lane.
template <int W>
struct alignas(W * sizeof(real)) LaneMask {
    using Integer = std::conditional_t<sizeof(real) == 4, std::int32_t, std::int64_t>;
    using Vector = typename VectorOf<Integer, W* int{sizeof(real)}>::Type;
    Vector v;  // 0 or -1 each

    friend LaneMask operator&(LaneMask a, LaneMask b) { return {a.v & b.v}; }
    friend LaneMask operator|(LaneMask a, LaneMask b) { return {a.v | b.v}; }
    friend LaneMask operator!(LaneMask a) { return {~a.v}; }
};

/// W reals that are reckoned with at once, on the vector extensions of the compiler. Each lane has the bits
/// that `real` would have: no operation here rounds in another way [ADR6].
template <int W>
struct alignas(W * sizeof(real)) Lane {
    using Vector = typename VectorOf<real, W* int{sizeof(real)}>::Type;
    Vector v;

    Lane() : v{} {}
    explicit Lane(Vector vector) : v(vector) {}
    Lane(real all) : v(all - Vector{}) {}  // one broadcast; x - 0 is x for every x, -0 included

    friend Lane operator+(Lane a, Lane b) { return Lane(a.v + b.v); }
    friend Lane operator-(Lane a, Lane b) { return Lane(a.v - b.v); }
    friend Lane operator*(Lane a, Lane b) { return Lane(a.v * b.v); }
    friend Lane operator/(Lane a, Lane b) { return Lane(a.v / b.v); }
    friend Lane operator-(Lane a) { return Lane(-a.v); }
    Lane& operator+=(Lane b) { return v += b.v, *this; }
    Lane& operator-=(Lane b) { return v -= b.v, *this; }
    Lane& operator*=(Lane b) { return v *= b.v, *this; }

    friend LaneMask<W> operator<(Lane a, Lane b) { return {a.v < b.v}; }
    friend LaneMask<W> operator>(Lane a, Lane b) { return {a.v > b.v}; }
    friend LaneMask<W> operator>=(Lane a, Lane b) { return {a.v >= b.v}; }
    // Not ==, which tells of vectors of lanes whether all are the same.
    friend LaneMask<W> isEqual(Lane a, Lane b) { return {a.v == b.v}; }
};

/// One lane is one number: g++ 12 loses stores of vectors of one element.
template <>
struct LaneMask<1> {
    using Integer = std::int32_t;
    Integer v[1];

    friend LaneMask operator&(LaneMask a, LaneMask b) { return {{a.v[0] & b.v[0]}}; }
    friend LaneMask operator|(LaneMask a, LaneMask b) { return {{a.v[0] | b.v[0]}}; }
    friend LaneMask operator!(LaneMask a) { return {{~a.v[0]}}; }
};
template <>
struct Lane<1> {
    real v[1];

    Lane() : v{0} {}
    Lane(real all) : v{all} {}

    friend Lane operator+(Lane a, Lane b) { return {a.v[0] + b.v[0]}; }
    friend Lane operator-(Lane a, Lane b) { return {a.v[0] - b.v[0]}; }
    friend Lane operator*(Lane a, Lane b) { return {a.v[0] * b.v[0]}; }
    friend Lane operator/(Lane a, Lane b) { return {a.v[0] / b.v[0]}; }
    friend Lane operator-(Lane a) { return {-a.v[0]}; }
    Lane& operator+=(Lane b) { return v[0] += b.v[0], *this; }
    Lane& operator-=(Lane b) { return v[0] -= b.v[0], *this; }
    Lane& operator*=(Lane b) { return v[0] *= b.v[0], *this; }

    friend LaneMask<1> operator<(Lane a, Lane b) { return {{a.v[0] < b.v[0] ? -1 : 0}}; }
    friend LaneMask<1> operator>(Lane a, Lane b) { return {{a.v[0] > b.v[0] ? -1 : 0}}; }
    friend LaneMask<1> operator>=(Lane a, Lane b) { return {{a.v[0] >= b.v[0] ? -1 : 0}}; }
    friend LaneMask<1> isEqual(Lane a, Lane b) { return {{a.v[0] == b.v[0] ? -1 : 0}}; }
};

/// `a` where the condition holds, else `b`.
template <int W>
Lane<W> select(LaneMask<W> condition, Lane<W> a, Lane<W> b)
{
    if constexpr (W == 1)
        return condition.v[0] != 0 ? a : b;
    else
        return Lane<W>(condition.v ? a.v : b.v);
}
template <class T>
    requires std::is_floating_point_v<T>
T select(bool condition, T a, T b)
{
    return condition ? a : b;
}

/// The truths as bits, lane 0 lowest.
template <int W>
TAMIAS_INLINE std::uint32_t bitsOf(LaneMask<W> mask)
{
#if defined(__x86_64__)
    if constexpr (W > 1 && sizeof mask.v == 16) {
        if constexpr (sizeof(real) == 4)
            return static_cast<std::uint32_t>(_mm_movemask_ps((__m128)mask.v));
        else
            return static_cast<std::uint32_t>(_mm_movemask_pd((__m128d)mask.v));
    }
#if defined(__AVX2__)
    if constexpr (sizeof mask.v == 32) {
        if constexpr (sizeof(real) == 4)
            return static_cast<std::uint32_t>(_mm256_movemask_ps((__m256)mask.v));
        else
            return static_cast<std::uint32_t>(_mm256_movemask_pd((__m256d)mask.v));
    }
#endif
#if defined(__AVX512DQ__)
    if constexpr (sizeof mask.v == 64) {
        if constexpr (sizeof(real) == 4)
            return _mm512_movepi32_mask((__m512i)mask.v);
        else
            return _mm512_movepi64_mask((__m512i)mask.v);
    }
#endif
#endif
    std::uint32_t bits = 0;
    for (int i = 0; i < W; ++i) bits |= (mask.v[i] != 0 ? 1u : 0u) << i;
    return bits;
}
template <int W>
TAMIAS_INLINE LaneMask<W> maskOf(std::uint32_t bits)
{
    LaneMask<W> mask{};
    using Integer = typename LaneMask<W>::Integer;
    if constexpr (W == 1) {
        mask.v[0] = (bits & 1u) != 0 ? -1 : 0;
    } else {
        typename LaneMask<W>::Vector each{};
        for (int i = 0; i < W; ++i) each[i] = Integer{1} << i;
        mask.v = (each & static_cast<Integer>(bits)) != 0;
    }
    return mask;
}

template <class T>
    requires std::is_floating_point_v<T>
bool isEqual(T a, T b)
{
    return a == b;
}

template <int W>
TAMIAS_INLINE bool any(LaneMask<W> mask)
{
    return bitsOf(mask) != 0;
}
inline bool any(bool mask)
{
    return mask;
}

// As those of scalar.hpp, lane by lane.
template <int W>
Lane<W> squareRoot(Lane<W> a)
{
    Lane<W> root;
    for (int i = 0; i < W; ++i) root.v[i] = std::sqrt(a.v[i]);
    return root;
}
inline real squareRoot(real a)
{
    return std::sqrt(a);
}
template <int W>
Lane<W> minimum(Lane<W> a, Lane<W> b)
{
    return select(a < b, a, b);
}
template <int W>
Lane<W> maximum(Lane<W> a, Lane<W> b)
{
    return select(a > b, a, b);
}
template <int W>
Lane<W> absolute(Lane<W> a)
{
    return select(a < Lane<W>(real(0)), -a, a);
}
template <int W>
Lane<W> clamp(Lane<W> a, Lane<W> low, Lane<W> high)
{
    return select(a < low, low, select(a > high, high, a));
}

/// Numbers that 16, 32 and 64 bytes hold.
inline constexpr int kLanes16 = 16 / sizeof(real), kLanes32 = 32 / sizeof(real), kLanes64 = 64 / sizeof(real);

/// Lanes that SSE2, NEON and the SIMD of wasm have: 16 bytes.
inline constexpr int kLanes = kLanes16;

/// The reals from `from` on.
template <int W = kLanes>
Lane<W> loadLane(const real* from)
{
    Lane<W> lane;
    __builtin_memcpy(&lane.v, from, sizeof lane.v);
    return lane;
}
template <int W>
void storeLane(Lane<W> lane, real* to)
{
    __builtin_memcpy(to, &lane.v, sizeof lane.v);
}

/// The vectors from `from` on, x and y apart.
template <int W>
BasicVec2<Lane<W>> loadVectors(const Vec2* from)
{
    typename Lane<W>::Vector low, high;
    const auto* bytes = reinterpret_cast<const unsigned char*>(from);
    __builtin_memcpy(&low, bytes, sizeof low);
    __builtin_memcpy(&high, bytes + sizeof low, sizeof high);
    if constexpr (W == 4)
        return {Lane<W>(__builtin_shufflevector(low, high, 0, 2, 4, 6)),
                Lane<W>(__builtin_shufflevector(low, high, 1, 3, 5, 7))};
    else
        return {Lane<W>(__builtin_shufflevector(low, high, 0, 2)),
                Lane<W>(__builtin_shufflevector(low, high, 1, 3))};
}

/// Four numbers that are read and written together, as those of a body are.
template <class T>
struct alignas(4 * sizeof(T)) RowOf {
    T x, y, z, w;
};
using LaneRow = RowOf<real>;

}  // namespace tamias2d::inline TAMIAS_PRECISION
