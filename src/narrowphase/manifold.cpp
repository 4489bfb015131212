// SPDX-License-Identifier: MIT
#include "narrowphase/manifold.hpp"

#include "narrowphase/face_kernel.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// The edge of the incident core that faces the reference normal most squarely.
int incidentEdge(const PlacedCore& core, Vec2 normal)
{
    int best = 0;
    real least = dot(normal, core.normals[0]);
    for (int i = 1; i < core.faces(); ++i) {
        const real along = dot(normal, core.normals[i]);
        if (along < least) least = along, best = i;
    }
    return best;
}

}  // namespace

bool faceManifold(const PlacedPair& pair, bool faceOnA, int face, bool force, Manifold& manifold)
{
    const PlacedCore& reference = faceOnA ? pair.coreA : pair.coreB;
    const PlacedCore& incident = faceOnA ? pair.coreB : pair.coreA;
    const Vec2 n = reference.normals[face];
    const Vec2 origin = reference.vertices[face];
    const int edge = incidentEdge(incident, n);
    const int edgeEnd = incident.next(edge);
    const ClippedEdge<real> clip = clipEdge(n, origin, reference.vertices[reference.next(face)],
                                            incident.vertices[edge], incident.vertices[edgeEnd]);
    if (clip.beyond && !force) return false;

    // Its two points, or the one that is nearest to a face it lies beyond.
    struct End {
        Vec2 point;
        int vertex;   // of the incident core
        int cut;      // 1 or 2: cut off at an end of the reference face
    };
    const End far{clip.far, clip.swapped ? edgeEnd : edge, clip.farCut ? 1 : 0};
    const End near{clip.near, clip.swapped ? edge : edgeEnd, clip.nearCut ? 2 : 0};
    const End ends[2] = {clip.beyond && !clip.before ? near : far, near};
    manifold.normal = faceOnA ? n : -n;
    manifold.count = clip.single ? 1 : 2;
    for (int i = 0; i < manifold.count; ++i) {
        const End& end = ends[i];
        const Vec2 onFace = footOn(n, origin, end.point);
        const Vec2 onA = faceOnA ? onFace : end.point;
        const Vec2 onB = faceOnA ? end.point : onFace;
        ManifoldPoint& point = manifold.points[i];
        point.localA = inverseRotate(pair.poseA.q, onA - pair.poseA.p);
        point.localB = inverseRotate(pair.poseB.q, onB - pair.poseB.p);
        point.cornerOnA = faceOnA == (end.cut != 0);
        point.roundOnRound = false;
        point.feature = featureOf(end.vertex, end.cut, faceOnA, face);
    }
    return true;
}

Separation coreSeparation(const PlacedPair& pair, real preference)
{
    return isSharpPair(pair.a, pair.b) ? separationByFaces(pair.cores, preference)
                                       : exactSeparation(pair.cores, preference);
}

real coreDistance(const PlacedPair& pair)
{
    return isSharpPair(pair.a, pair.b) ? distanceByFaces(pair.cores)
                                       : exactSeparation(pair.cores, 0).distance;
}

bool isSharpPair(const Convex& a, const Convex& b)
{
    return a.faces() > 0 && b.faces() > 0 && a.radius + b.radius <= 0 && a.count + b.count > 4;
}

namespace {

// Where two roundings meet end to end and lie nearly along each other, one point would let them rock into
// each other at the far end within a step: that end is the second point.
void addFarEnd(const PlacedPair& pair, Manifold& manifold)
{
    constexpr real kAlong = real(0.98);   // cosine: 11 degrees
    const PlacedCore &coreA = pair.coreA, &coreB = pair.coreB;
    if (coreA.faces() == 0 || coreB.faces() == 0) return;
    const Vec2 n = manifold.normal;
    const int faceA = incidentEdge(coreA, -n), faceB = incidentEdge(coreB, n);
    const real alongA = dot(coreA.normals[faceA], n), alongB = -dot(coreB.normals[faceB], n);
    if (!(minimum(alongA, alongB) > kAlong)) return;

    Manifold ends;
    const bool onA = alongA >= alongB;
    if (!faceManifold(pair, onA, onA ? faceA : faceB, false, ends) || ends.count < 2) return;
    ManifoldPoint& near = manifold.points[0];
    const auto distance = [&](const ManifoldPoint& p) { return length(p.localA - near.localA); };
    manifold.points[1] = ends.points[distance(ends.points[0]) > distance(ends.points[1]) ? 0 : 1];
    near.roundOnRound = false;   // the two share one normal
    manifold.count = 2;
}

}  // namespace

void closestManifold(const PlacedPair& pair, real preference, Manifold& manifold)
{
    closestManifold(pair, coreSeparation(pair, preference), manifold);
}

void closestManifold(const PlacedPair& pair, const Separation& nearest, Manifold& manifold)
{
    const bool onA = nearest.kind == Separation::Kind::FaceA;
    if (nearest.kind != Separation::Kind::Vertices) {
        faceManifold(pair, onA, onA ? nearest.featureA : nearest.featureB, true, manifold);
        return;
    }
    vertexManifold(pair.a, pair.b, nearest, manifold);
    if (manifold.points[0].roundOnRound) addFarEnd(pair, manifold);
}

void vertexManifold(const Convex& a, const Convex& b, const Separation& nearest, Manifold& manifold)
{
    manifold.normal = nearest.normal;
    manifold.count = 1;
    ManifoldPoint& point = manifold.points[0];
    point.localA = a.vertices[static_cast<std::size_t>(nearest.featureA)];
    point.localB = b.vertices[static_cast<std::size_t>(nearest.featureB)];
    point.cornerOnA = a.radius > b.radius;  // on the rounder one: its turning must not lever on the other
    point.roundOnRound = a.radius + b.radius > 0;
    point.feature = static_cast<std::uint32_t>(nearest.featureA | (nearest.featureB << 4) | (1 << 12));
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
