// SPDX-License-Identifier: MIT
// How pairs meet, for one width: included once for each instruction set, by a file that is compiled with the
// switches of that set.
#pragma once

#include "math/lane_rows.hpp"
#include "narrowphase/disc_kernel.hpp"
#include "narrowphase/polygon_kernel.hpp"
#include "narrowphase/side_by_side.hpp"

#include <cstddef>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// The reals of each pair that belong to neither shape nor body.
template <int W>
struct PairColumns {
    BasicVec2<Lane<W>> positionA, positionB;
    Lane<W> restGap, extentA, extentB, radii;
};

// Lanes beyond `count` repeat the first pair.
TAMIAS_INLINE const PairOnWay& pairInLane(const PairOnWay* pairs, int count, int lane)
{
    return pairs[lane < count ? lane : 0];
}

template <int W>
PairColumns<W> readPairs(const PairOnWay* pairs, int count)
{
    real rows[W][8];
    const real* pointers[W];
    for (int i = 0; i < W; ++i) {
        const PairOnWay& p = pairInLane(pairs, count, i);
        const real row[8] = {p.positionA.x, p.positionA.y, p.positionB.x, p.positionB.y,
                             p.restGap,     p.a->extent,   p.b->extent,   p.a->radius + p.b->radius};
        for (int k = 0; k < 8; ++k) rows[i][k] = row[k];
        pointers[i] = rows[i];
    }
    Lane<W> c[8];
    loadColumns<8>(pointers, c);
    return {{c[0], c[1]}, {c[2], c[3]}, c[4], c[5], c[6], c[7]};
}

template <int W>
struct WayColumns {
    BasicPose<Lane<W>> start, end;
    Lane<W> turn;
};

template <const SpanOfWay* PairOnWay::* Way, int W>
WayColumns<W> readWays(const PairOnWay* pairs, int count, BasicVec2<Lane<W>> position)
{
    const real* rows[W];
    for (int i = 0; i < W; ++i) rows[i] = &(pairInLane(pairs, count, i).*Way)->start.c;
    Lane<W> c[12];
    loadColumns<12>(rows, c);
    const BasicVec2<Lane<W>> byVelocity{c[4], c[5]}, byAcceleration{c[6], c[7]};
    return {{position, c[0], c[1]}, {(position + byVelocity) + byAcceleration, c[2], c[3]}, c[8]};
}

template <const Convex* PairOnWay::* Shape, int N, int W>
void readShapes(const PairOnWay* pairs, int count, PolygonOnWay<Lane<W>, N>& polygon)
{
    const real *vertices[W], *normals[W];
    real last[W];
    for (int i = 0; i < W; ++i) {
        const Convex& shape = *(pairInLane(pairs, count, i).*Shape);
        vertices[i] = &shape.vertices.data()->x;
        normals[i] = &shape.normals.data()->x;
        last[i] = static_cast<real>(shape.count - 1);
    }
    polygon.last = loadLane<W>(last);
    Lane<W> v[2 * N], n[2 * N];
    loadColumns<2 * N>(vertices, v);
    loadColumns<2 * N>(normals, n);
    for (int i = 0; i < N; ++i) {
        polygon.vertices[i] = {v[2 * i], v[2 * i + 1]};
        polygon.normals[i] = {n[2 * i], n[2 * i + 1]};
    }
}

// A group of four reals in the results of all lanes, at that offset.
struct ResultGroups {
    SweptResult* const* results;
    std::size_t offset;

    TAMIAS_INLINE std::byte* at(int lane) const
    {
        return reinterpret_cast<std::byte*>(results[lane]) + offset;
    }
};
constexpr std::size_t kGapGroup = offsetof(SweptResult, startGap);
static_assert(offsetof(SweptResult, apart) == kGapGroup + sizeof(real) && sizeof(Apart) == 3 * sizeof(real));
constexpr std::size_t kPointGroup = offsetof(SweptResult, manifold) + offsetof(Manifold, points);
static_assert(offsetof(ManifoldPoint, localB) == 2 * sizeof(real));
constexpr std::size_t kPlaceGroup = offsetof(SweptResult, places);
static_assert(offsetof(PlacedPoint, armB) == 2 * sizeof(real));

template <int W>
struct LaneBits {
    std::uint32_t near, bends, single, cornerOnA[2];
    real normalX[W], normalY[W], features[2][W], gaps[2][W];

    explicit LaneBits(const PolygonResult<Lane<W>>& lanes)
        : near(bitsOf(lanes.near)), bends(bitsOf(lanes.bends)), single(bitsOf(lanes.single)),
          cornerOnA{bitsOf(lanes.points[0].cornerOnA), bitsOf(lanes.points[1].cornerOnA)}
    {
        const Lane<W> zero(real(0));
        storeLane(select(lanes.near, lanes.normal.x, zero), normalX);
        storeLane(select(lanes.near, lanes.normal.y, zero), normalY);
        for (int k = 0; k < 2; ++k) {
            storeLane(lanes.points[k].feature, features[k]);
            storeLane(lanes.points[k].place.gap, gaps[k]);
        }
    }
};

template <int W>
void write(const PolygonResult<Lane<W>>& lanes, int count, SweptResult* const* results)
{
    const std::uint32_t written = (std::uint32_t{2} << (count - 1)) - 1;
    scatterRows<W>({lanes.startGap, lanes.axis.x, lanes.axis.y, lanes.apart},
                   ResultGroups{results, kGapGroup}, written);
    const LaneBits<W> bits(lanes);
    if (bits.near != 0) {
        for (std::size_t k = 0; k < 2; ++k) {
            const PolygonPoint<Lane<W>>& p = lanes.points[k];
            scatterRows<W>({p.localA.x, p.localA.y, p.localB.x, p.localB.y},
                           ResultGroups{results, kPointGroup + k * sizeof(ManifoldPoint)}, written);
            scatterRows<W>({p.place.armA.x, p.place.armA.y, p.place.armB.x, p.place.armB.y},
                           ResultGroups{results, kPlaceGroup + k * sizeof(PlacedPoint)}, written);
        }
    }
    const auto has = [](std::uint32_t mask, int i) { return (mask >> i & 1u) != 0; };
    for (int i = 0; i < count; ++i) {
        SweptResult& result = *results[i];
        result.near = has(bits.near, i);
        result.exhausted = false;
        result.bends = has(bits.bends, i);
        Manifold& manifold = result.manifold;
        manifold.normal = {bits.normalX[i], bits.normalY[i]};
        manifold.count = !result.near ? 0 : has(bits.single, i) ? 1 : 2;
        manifold.time = 0;
        manifold.atImpact = false;
        result.placed = result.near;
        for (int k = 0; k < 2; ++k) {
            manifold.points[k].cornerOnA = has(bits.cornerOnA[k], i);
            manifold.points[k].roundOnRound = false;
            manifold.points[k].feature = static_cast<std::uint32_t>(bits.features[k][i]);
            result.places[k].gap = bits.gaps[k][i];
        }
    }
}

template <int W>
void write(const DiscResult<Lane<W>>& lanes, int i, const PairOnWay& pair, SweptResult& result)
{
    result = {};
    result.startGap = lanes.startGap.v[i];
    result.apart = {{lanes.axis.x.v[i], lanes.axis.y.v[i]}, result.startGap};
    result.near = lanes.near.v[i] != 0;
    if (!result.near) return;
    result.bends = lanes.bends.v[i] != 0;
    const Separation nearest{0, {lanes.normal.x.v[i], lanes.normal.y.v[i]}, Separation::Kind::Vertices, 0, 0};
    vertexManifold(*pair.a, *pair.b, nearest, result.manifold);
}

template <int N, int W>
std::uint32_t collidePolygons(const PairOnWay* pairs, int count, SweptResult* const* results)
{
    const PairColumns<W> own = readPairs<W>(pairs, count);
    const WayColumns<W> wayA = readWays<&PairOnWay::wayA>(pairs, count, own.positionA);
    const WayColumns<W> wayB = readWays<&PairOnWay::wayB>(pairs, count, own.positionB);
    PolygonOnWay<Lane<W>, N> a, b;
    readShapes<&PairOnWay::a>(pairs, count, a);
    readShapes<&PairOnWay::b>(pairs, count, b);
    a.start = wayA.start, a.end = wayA.end, a.turn = wayA.turn, a.extent = own.extentA;
    b.start = wayB.start, b.end = wayB.end, b.turn = wayB.turn, b.extent = own.extentB;
    PolygonResult<Lane<W>> lanes;
    collidePolygons(a, b, own.restGap, lanes);
    write(lanes, count, results);
    return bitsOf(lanes.decided);
}

template <int W>
std::uint32_t collideDiscs(const PairOnWay* pairs, int count, SweptResult* const* results)
{
    const PairColumns<W> own = readPairs<W>(pairs, count);
    const WayColumns<W> a = readWays<&PairOnWay::wayA>(pairs, count, own.positionA);
    const WayColumns<W> b = readWays<&PairOnWay::wayB>(pairs, count, own.positionB);
    const DiscResult<Lane<W>> lanes =
        collideDiscs(DiscsOnWay<Lane<W>>{{b.start.p - a.start.p, b.end.p - a.end.p},
                                         own.radii,
                                         a.turn * own.extentA,
                                         b.turn * own.extentB,
                                         own.restGap});
    const std::uint32_t decided = bitsOf(lanes.decided);
    for (int i = 0; i < count; ++i)
        if ((decided >> i & 1u) != 0) write(lanes, i, pairs[i], *results[i]);
    return decided;
}

template <int W>
std::uint32_t collide(LaneKind kind, const PairOnWay* pairs, int count, SweptResult* const* results)
{
    switch (kind) {
    case LaneKind::Corners4:
        return collidePolygons<4, W>(pairs, count, results);
    case LaneKind::Corners6:
        return collidePolygons<6, W>(pairs, count, results);
    case LaneKind::Corners8:
        return collidePolygons<8, W>(pairs, count, results);
    case LaneKind::Discs:
        return collideDiscs<W>(pairs, count, results);
    case LaneKind::None:
        break;
    }
    return 0;
}

}  // namespace

template <int W>
const PairKernels PairKernelsOf<W>::kTable = {W, collide<W>};

}  // namespace tamias2d::inline TAMIAS_PRECISION
