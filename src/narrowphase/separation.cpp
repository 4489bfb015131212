// SPDX-License-Identifier: MIT
#include "narrowphase/separation.hpp"

#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {

FaceDistances::FaceDistances(const PlacedCore& core, const PlacedCore& other)
{
    for (int i = 0; i < core.faces(); i += kLanes) {
        const BasicVec2<Lanes> n = core.normals.lanes(i), origin = core.vertices.lanes(i);
        Lanes least(std::numeric_limits<real>::max());
        for (int k = 0; k < other.count; ++k) {
            const BasicVec2<Lanes> vertex{other.vertices[k].x, other.vertices[k].y};
            least = minimum(least, dot(n, vertex - origin));
        }
        storeLane(least, distances_ + i);
    }
}

FaceQuery bestFace(const FacedCores& cores, real preference)
{
    FaceQuery best{-std::numeric_limits<real>::max(), true, 0};
    for (int i = 0; i < cores.a.faces(); ++i)
        if (cores.fromA[i] > best.distance) best = {cores.fromA[i], true, i};
    for (int i = 0; i < cores.b.faces(); ++i) {
        const bool handicap = best.onA && cores.a.faces() > 0;
        if (cores.fromB[i] > best.distance + (handicap ? preference : real(0)))
            best = {cores.fromB[i], false, i};
    }
    return best;
}

real distanceByFaces(const FacedCores& cores)
{
    real greatest = -std::numeric_limits<real>::max();
    for (int i = 0; i < cores.a.faces(); ++i) greatest = maximum(cores.fromA[i], greatest);
    for (int i = 0; i < cores.b.faces(); ++i) greatest = maximum(cores.fromB[i], greatest);
    return greatest;
}

Separation separationByFaces(const FacedCores& cores, real preference)
{
    const FaceQuery best = bestFace(cores, preference);
    if (best.onA) return {best.distance, cores.a.normals[best.face], Separation::Kind::FaceA, best.face, 0};
    return {best.distance, -cores.b.normals[best.face], Separation::Kind::FaceB, 0, best.face};
}

namespace {

// Is the vertex of `other` nearest to the face also opposite to it? Then the face distance is exact.
bool nearestVertexIsOpposite(const PlacedCore& core, int i, const PlacedCore& other)
{
    const Vec2 n = core.normals[i];
    int nearest = 0;
    for (int k = 1; k < other.count; ++k)
        if (dot(n, other.vertices[k]) < dot(n, other.vertices[nearest])) nearest = k;
    const Vec2 edge = core.vertices[core.next(i)] - core.vertices[i];
    const real along = dot(edge, other.vertices[nearest] - core.vertices[i]);
    return along >= 0 && along <= dot(edge, edge);
}

// The closest pair of a vertex of `points` and a feature of `core`: updates `best` if nearer.
// `coreIsA` says which of the two is body A.
void closestVertexToCore(const PlacedCore& core, const PlacedCore& points, bool coreIsA, real& bestSquared,
                         Separation& best)
{
    for (int k = 0; k < points.count; ++k) {
        for (int i = 0; i < core.count; ++i) {
            const Vec2 p = points.vertices[k];
            const Vec2 d = p - core.vertices[i];
            if (dot(d, d) < bestSquared) {
                bestSquared = dot(d, d);
                best.kind = Separation::Kind::Vertices;
                best.featureA = coreIsA ? i : k;
                best.featureB = coreIsA ? k : i;
                best.normal = coreIsA ? d : -d;  // made a unit vector at the end
            }
            if (core.faces() == 0) continue;
            const Vec2 edge = core.vertices[core.next(i)] - core.vertices[i];
            const real along = dot(edge, d);
            const real distance = dot(core.normals[i], d);
            if (along <= 0 || along >= dot(edge, edge) || distance < 0) continue;
            if (distance * distance < bestSquared) {
                bestSquared = distance * distance;
                best.kind = coreIsA ? Separation::Kind::FaceA : Separation::Kind::FaceB;
                best.featureA = coreIsA ? i : 0;
                best.featureB = coreIsA ? 0 : i;
                best.normal = coreIsA ? core.normals[i] : -core.normals[i];
                best.distance = distance;
            }
        }
    }
}

Separation closestFeatures(const PlacedCore& a, const PlacedCore& b)
{
    real squared = std::numeric_limits<real>::max();
    Separation best{0, {0, 1}, Separation::Kind::Vertices, 0, 0};
    if (a.count == 1 && b.count == 1) {
        best.normal = b.vertices[0] - a.vertices[0];
    } else {
        closestVertexToCore(a, b, true, squared, best);
        closestVertexToCore(b, a, false, squared, best);
    }
    if (best.kind != Separation::Kind::Vertices) return best;

    best.distance = length(best.normal);
    best.normal = best.distance > 0 ? (1 / best.distance) * best.normal : Vec2{0, 1};
    return best;
}

// Two lines that lie on one another's extension are apart although no face separates them.
bool isApartAlong(const PlacedCore& line, const PlacedCore& other)
{
    const Vec2 along = perpendicular(line.normals[0]);
    const real a0 = dot(along, line.vertices[0]), a1 = dot(along, line.vertices[1]);
    const real b0 = dot(along, other.vertices[0]), b1 = dot(along, other.vertices[1]);
    return maximum(a0, a1) < minimum(b0, b1) || maximum(b0, b1) < minimum(a0, a1);
}

// Features that meet have no direction between them; and what lies on a line lies in front of both its faces.
bool tellsDirection(const FacedCores& cores, const Separation& nearest)
{
    if (!(nearest.distance > 0)) return false;
    if (nearest.kind == Separation::Kind::FaceA) return cores.fromA[nearest.featureA] >= 0;
    return nearest.kind != Separation::Kind::FaceB || cores.fromB[nearest.featureB] >= 0;
}

}  // namespace

Separation exactSeparation(const FacedCores& cores, real preference)
{
    const PlacedCore &a = cores.a, &b = cores.b;
    if (a.faces() == 0 && b.faces() == 0) return closestFeatures(a, b);

    const Separation byFace = separationByFaces(cores, preference);
    const bool linesApart = a.count == 2 && b.count == 2 && (isApartAlong(a, b) || isApartAlong(b, a));
    if (byFace.distance < 0 && !linesApart) return byFace;

    const bool onA = byFace.kind == Separation::Kind::FaceA;
    if (!linesApart && (onA ? nearestVertexIsOpposite(a, byFace.featureA, b)
                            : nearestVertexIsOpposite(b, byFace.featureB, a)))
        return byFace;
    const Separation nearest = closestFeatures(a, b);
    return tellsDirection(cores, nearest) ? nearest : byFace;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
