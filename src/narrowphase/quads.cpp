// SPDX-License-Identifier: MIT
#include "narrowphase/quads.hpp"

#include "narrowphase/quad_kernel.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

SpanOfWay::SpanOfWay(const Trajectory& path, real to)
    : start(path.rotation), end(path.at(to).q), byVelocity(to * path.velocity),
      byAcceleration((to * to / 2) * path.acceleration), turn(absolute(path.turnBy(to) - path.turnBy(0)))
{
}

namespace {

// The reals of each pair that belong to neither shape nor body.
struct PairRow {
    real positions[4];
    real restGap, extentA, extentB, unused;
};

using Rows = const real* [kLanes];

void readShape(const Rows& vertices, const Rows& normals, QuadOnWay<Lanes>& quad)
{
    Lanes columns[8];
    loadColumns<8>(vertices, columns);
    for (int i = 0; i < 4; ++i) quad.vertices[i] = {columns[2 * i], columns[2 * i + 1]};
    loadColumns<8>(normals, columns);
    for (int i = 0; i < 4; ++i) quad.normals[i] = {columns[2 * i], columns[2 * i + 1]};
}

void readWay(const Rows& ways, BasicVec2<Lanes> position, QuadOnWay<Lanes>& quad)
{
    Lanes way[12];
    loadColumns<12>(ways, way);
    quad.start = {position, way[0], way[1]};
    quad.end = {(position + BasicVec2<Lanes>{way[4], way[5]}) + BasicVec2<Lanes>{way[6], way[7]}, way[2],
                way[3]};
    quad.turn = way[8];
}

void read(const QuadPair* pairs, int count, QuadOnWay<Lanes>& a, QuadOnWay<Lanes>& b, Lanes& restGap)
{
    Rows verticesA, normalsA, waysA, verticesB, normalsB, waysB, rows;
    PairRow pairRows[kLanes];
    for (int i = 0; i < kLanes; ++i) {
        const QuadPair& pair = pairs[i < count ? i : 0];
        verticesA[i] = &pair.a->vertices[0].x;
        normalsA[i] = &pair.a->normals[0].x;
        waysA[i] = &pair.wayA->start.c;
        verticesB[i] = &pair.b->vertices[0].x;
        normalsB[i] = &pair.b->normals[0].x;
        waysB[i] = &pair.wayB->start.c;
        pairRows[i] = {{pair.positionA.x, pair.positionA.y, pair.positionB.x, pair.positionB.y},
                       pair.restGap,
                       pair.a->extent,
                       pair.b->extent,
                       0};
        rows[i] = pairRows[i].positions;
    }
    Lanes own[8];
    loadColumns<8>(rows, own);
    restGap = own[4];
    a.extent = own[5];
    b.extent = own[6];
    readShape(verticesA, normalsA, a);
    readShape(verticesB, normalsB, b);
    readWay(waysA, {own[0], own[1]}, a);
    readWay(waysB, {own[2], own[3]}, b);
}

void write(const QuadResult<Lanes>& lanes, int i, SweptResult& result)
{
    result = {};
    result.startGap = lanes.startGap.v[i];
    result.near = lanes.near.v[i] != 0;
    if (!result.near) return;
    result.bends = lanes.bends.v[i] != 0;
    Manifold& manifold = result.manifold;
    manifold.normal = {lanes.normal.x.v[i], lanes.normal.y.v[i]};
    manifold.count = lanes.single.v[i] != 0 ? 1 : 2;
    for (int k = 0; k < manifold.count; ++k) {
        const QuadPoint<Lanes>& from = lanes.points[k];
        ManifoldPoint& to = manifold.points[k];
        to.localA = {from.localA.x.v[i], from.localA.y.v[i]};
        to.localB = {from.localB.x.v[i], from.localB.y.v[i]};
        to.cornerOnA = from.cornerOnA.v[i] != 0;
        to.feature = static_cast<std::uint32_t>(from.feature.v[i]);
    }
}

}  // namespace

void collideQuads(const QuadPair* pairs, int count, SweptResult* results, bool* decided)
{
    QuadOnWay<Lanes> a, b;
    Lanes restGap;
    read(pairs, count, a, b, restGap);
    QuadResult<Lanes> lanes;
    collideQuads(a, b, restGap, lanes);
    for (int i = 0; i < count; ++i) {
        decided[i] = lanes.decided.v[i] != 0;
        if (decided[i]) write(lanes, i, results[i]);
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
