// SPDX-License-Identifier: MIT
#include "narrowphase/separation.hpp"

#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {

real faceDistance(const PlacedCore& core, int i, const PlacedCore& other)
{
    const Vec2 n = core.normals[i];
    const Vec2 origin = core.vertices[i];
    real least = std::numeric_limits<real>::max();
    for (int k = 0; k < other.count; ++k) least = minimum(least, dot(n, other.vertices[k] - origin));
    return least;
}

FaceQuery bestFace(const PlacedCore& a, const PlacedCore& b, real preference)
{
    FaceQuery best{-std::numeric_limits<real>::max(), true, 0};
    for (int i = 0; i < a.faces(); ++i) {
        const real distance = faceDistance(a, i, b);
        if (distance > best.distance) best = {distance, true, i};
    }
    for (int i = 0; i < b.faces(); ++i) {
        const real distance = faceDistance(b, i, a);
        if (distance > best.distance + (best.onA && a.faces() > 0 ? preference : real(0)))
            best = {distance, false, i};
    }
    return best;
}

Separation separationByFaces(const PlacedCore& a, const PlacedCore& b, real preference)
{
    const FaceQuery best = bestFace(a, b, preference);
    if (best.onA) return {best.distance, a.normals[best.face], Separation::Kind::FaceA, best.face, 0};
    return {best.distance, -b.normals[best.face], Separation::Kind::FaceB, 0, best.face};
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
    closestVertexToCore(a, b, true, squared, best);
    closestVertexToCore(b, a, false, squared, best);
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

}  // namespace

Separation exactSeparation(const PlacedCore& a, const PlacedCore& b, real preference)
{
    if (a.faces() == 0 && b.faces() == 0) return closestFeatures(a, b);

    const Separation byFace = separationByFaces(a, b, preference);
    const bool linesApart = a.count == 2 && b.count == 2 && (isApartAlong(a, b) || isApartAlong(b, a));
    if (byFace.distance < 0 && !linesApart) return byFace;

    const bool onA = byFace.kind == Separation::Kind::FaceA;
    if (!linesApart && (onA ? nearestVertexIsOpposite(a, byFace.featureA, b)
                            : nearestVertexIsOpposite(b, byFace.featureB, a)))
        return byFace;
    return closestFeatures(a, b);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
