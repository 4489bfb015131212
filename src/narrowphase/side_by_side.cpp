// SPDX-License-Identifier: MIT
#include "narrowphase/side_by_side.hpp"

#include "narrowphase/disc_kernel.hpp"
#include "narrowphase/polygon_kernel.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

SpanOfWay::SpanOfWay(const Trajectory& path, real to)
    : start(path.rotation), end(path.aheadTime == to ? path.ahead : path.rotation),
      byVelocity(to * path.velocity), byAcceleration((to * to / 2) * path.acceleration),
      turn(absolute(path.turnBy(to) - path.turnBy(0)))
{
}

namespace {

using Rows = const real* [kLanes];

// The reals of each pair that belong to neither shape nor body.
struct PairColumns {
    BasicVec2<Lanes> positionA, positionB;
    Lanes restGap, extentA, extentB, radii;
};

// Lanes beyond `count` repeat the first pair.
const PairOnWay& pairOf(const PairOnWay* pairs, int count, int lane)
{
    return pairs[lane < count ? lane : 0];
}

PairColumns readPairs(const PairOnWay* pairs, int count)
{
    real rows[kLanes][8];
    Rows pointers;
    for (int i = 0; i < kLanes; ++i) {
        const PairOnWay& p = pairOf(pairs, count, i);
        const real row[8] = {p.positionA.x, p.positionA.y, p.positionB.x, p.positionB.y,
                             p.restGap,     p.a->extent,   p.b->extent,   p.a->radius + p.b->radius};
        for (int k = 0; k < 8; ++k) rows[i][k] = row[k];
        pointers[i] = rows[i];
    }
    Lanes c[8];
    loadColumns<8>(pointers, c);
    return {{c[0], c[1]}, {c[2], c[3]}, c[4], c[5], c[6], c[7]};
}

struct WayColumns {
    BasicPose<Lanes> start, end;
    Lanes turn;
};

template <const SpanOfWay* PairOnWay::* Way>
WayColumns readWays(const PairOnWay* pairs, int count, BasicVec2<Lanes> position)
{
    Rows rows;
    for (int i = 0; i < kLanes; ++i) rows[i] = &(pairOf(pairs, count, i).*Way)->start.c;
    Lanes c[12];
    loadColumns<12>(rows, c);
    const BasicVec2<Lanes> byVelocity{c[4], c[5]}, byAcceleration{c[6], c[7]};
    return {{position, c[0], c[1]}, {(position + byVelocity) + byAcceleration, c[2], c[3]}, c[8]};
}

template <const Convex* PairOnWay::* Shape, int N>
void readShapes(const PairOnWay* pairs, int count, PolygonOnWay<Lanes, N>& polygon)
{
    Rows vertices, normals;
    for (int i = 0; i < kLanes; ++i) {
        const Convex& shape = *(pairOf(pairs, count, i).*Shape);
        vertices[i] = &shape.vertices[0].x;
        normals[i] = &shape.normals[0].x;
        polygon.last.v[i] = static_cast<real>(shape.count - 1);
    }
    Lanes v[2 * N], n[2 * N];
    loadColumns<2 * N>(vertices, v);
    loadColumns<2 * N>(normals, n);
    for (int i = 0; i < N; ++i) {
        polygon.vertices[i] = {v[2 * i], v[2 * i + 1]};
        polygon.normals[i] = {n[2 * i], n[2 * i + 1]};
    }
}

void write(const PolygonResult<Lanes>& lanes, int i, SweptResult& result)
{
    result = {};
    result.startGap = lanes.startGap.v[i];
    result.apart = {{lanes.axis.x.v[i], lanes.axis.y.v[i]}, lanes.apart.v[i]};
    result.near = lanes.near.v[i] != 0;
    if (!result.near) return;
    result.bends = lanes.bends.v[i] != 0;
    Manifold& manifold = result.manifold;
    manifold.normal = {lanes.normal.x.v[i], lanes.normal.y.v[i]};
    manifold.count = lanes.single.v[i] != 0 ? 1 : 2;
    for (int k = 0; k < manifold.count; ++k) {
        const PolygonPoint<Lanes>& from = lanes.points[k];
        ManifoldPoint& to = manifold.points[k];
        to.localA = {from.localA.x.v[i], from.localA.y.v[i]};
        to.localB = {from.localB.x.v[i], from.localB.y.v[i]};
        to.cornerOnA = from.cornerOnA.v[i] != 0;
        to.feature = static_cast<std::uint32_t>(from.feature.v[i]);
    }
}

void write(const DiscResult<Lanes>& lanes, int i, const PairOnWay& pair, SweptResult& result)
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

template <int N>
void collidePolygons(const PairOnWay* pairs, int count, SweptResult* results, bool* decided)
{
    const PairColumns own = readPairs(pairs, count);
    const WayColumns wayA = readWays<&PairOnWay::wayA>(pairs, count, own.positionA);
    const WayColumns wayB = readWays<&PairOnWay::wayB>(pairs, count, own.positionB);
    PolygonOnWay<Lanes, N> a, b;
    readShapes<&PairOnWay::a>(pairs, count, a);
    readShapes<&PairOnWay::b>(pairs, count, b);
    a.start = wayA.start, a.end = wayA.end, a.turn = wayA.turn, a.extent = own.extentA;
    b.start = wayB.start, b.end = wayB.end, b.turn = wayB.turn, b.extent = own.extentB;
    PolygonResult<Lanes> lanes;
    collidePolygons(a, b, own.restGap, lanes);
    for (int i = 0; i < count; ++i) {
        decided[i] = lanes.decided.v[i] != 0;
        if (decided[i]) write(lanes, i, results[i]);
    }
}

void collideDiscs(const PairOnWay* pairs, int count, SweptResult* results, bool* decided)
{
    const PairColumns own = readPairs(pairs, count);
    const WayColumns a = readWays<&PairOnWay::wayA>(pairs, count, own.positionA);
    const WayColumns b = readWays<&PairOnWay::wayB>(pairs, count, own.positionB);
    const DiscResult<Lanes> lanes = collideDiscs(DiscsOnWay<Lanes>{{b.start.p - a.start.p, b.end.p - a.end.p},
                                                                   own.radii,
                                                                   a.turn * own.extentA,
                                                                   b.turn * own.extentB,
                                                                   own.restGap});
    for (int i = 0; i < count; ++i) {
        decided[i] = lanes.decided.v[i] != 0;
        if (decided[i]) write(lanes, i, pairs[i], results[i]);
    }
}

}  // namespace

LaneKind laneKindOf(const Convex& a, const Convex& b)
{
    if (a.isDisc() && b.isDisc()) return LaneKind::Discs;
    if (!isSharpPair(a, b)) return LaneKind::None;
    const int corners = a.count > b.count ? a.count : b.count;
    return corners <= 4   ? LaneKind::Corners4
           : corners <= 6 ? LaneKind::Corners6
           : corners <= 8 ? LaneKind::Corners8
                          : LaneKind::None;
}

void collideInLanes(LaneKind kind, const PairOnWay* pairs, int count, SweptResult* results, bool* decided)
{
    switch (kind) {
    case LaneKind::Corners4:
        return collidePolygons<4>(pairs, count, results, decided);
    case LaneKind::Corners6:
        return collidePolygons<6>(pairs, count, results, decided);
    case LaneKind::Corners8:
        return collidePolygons<8>(pairs, count, results, decided);
    case LaneKind::Discs:
        return collideDiscs(pairs, count, results, decided);
    case LaneKind::None:
        for (int i = 0; i < count; ++i) decided[i] = false;
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
