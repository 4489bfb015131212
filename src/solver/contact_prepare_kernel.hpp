// SPDX-License-Identifier: MIT
// Blocks of contacts where their bodies are, and their sums, for one width: what several kernels begin with.
#pragma once

#include "solver/contact_kernels.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

template <int W>
BodyMotion<Lane<W>> motionOf(const FourLanes<W>& rows)
{
    return {{rows.x, rows.y}, rows.z};
}
template <int W>
void setMotion(FourLanes<W>& rows, const BodyMotion<Lane<W>>& motion)
{
    rows.x = motion.velocity.x;
    rows.y = motion.velocity.y;
    rows.z = motion.spin;
}

// Adds what the tick before gave to the sums of the step.
template <int W>
void addUp(const ContactBlock<W>& block, ContactSource<W>& source)
{
    using Wide = Lane<W>;
    const Wide zero(real(0));
    const BasicVec2<Wide> n = block.row.normal, t = perpendicular(n);
    for (int k = 0; k < block.points(); ++k) {
        const PointRow<Wide>& p = block.row.points[k];
        const Wide normal = select(source.counted, p.normalImpulse, zero);
        const Wide tangent = select(source.counted, p.tangentImpulse, zero);
        source.stepNormal[k] += normal;
        source.stepTangent[k] += tangent;
        source.stepImpulse += normal * n + tangent * t;
    }
}

template <int W>
BasicVec2<Lane<W>> apart(const ContactSource<W>& source, const FourLanes<W>& a, const FourLanes<W>& b)
{
    return {source.start.x + (b.x - a.x), source.start.y + (b.y - a.y)};
}

template <int W>
void prepareAt(ContactBlock<W>& block, ContactSource<W>& source, const TickRows& rows, real invH)
{
    using Wide = Lane<W>;
    const FourLanes<W> a = gatherRows<W>(rows.poses.data(), block.rowA);
    const FourLanes<W> b = gatherRows<W>(rows.poses.data(), block.rowB);
    const BasicVec2<Wide> d = apart(source, a, b);
    const auto rotated = [](const FourLanes<W>& pose, BasicVec2<Wide> v) {
        return BasicVec2<Wide>{pose.z * v.x - pose.w * v.y, pose.w * v.x + pose.z * v.y};
    };
    const int points = block.points();
    BasicVec2<Wide> coreA[2], coreB[2];
    for (int k = 0; k < points; ++k) {
        coreA[k] = rotated(a, source.localA[k]);
        coreB[k] = rotated(b, source.localB[k]);
    }
    if (any(source.turns)) {
        const Wide zero(real(0));
        BasicVec2<Wide>& n = block.row.normal;
        const BasicVec2<Wide> between = d + coreB[0] - coreA[0];
        const Wide distance = squareRoot(dot(between, between));
        auto turned = source.turns & (distance > zero);
        if (block.out != 0) turned = turned & maskOf<W>(block.active);
        const BasicVec2<Wide> unit = (Wide(real(1)) / distance) * between;
        n = {select(turned, unit.x, n.x), select(turned, unit.y, n.y)};
    }
    const BasicVec2<Wide> n = block.row.normal;
    const Wide linear = prepareCenters(block.row);
    for (int k = 0; k < points; ++k) {
        const BasicVec2<Wide> surfaceA = coreA[k] + source.radiusA * n;
        const BasicVec2<Wide> surfaceB = coreB[k] - source.radiusB * n;
        const Wide gap = dot(n, d + surfaceB - surfaceA) - source.restGap;
        const auto onA = source.cornerOnA[k];
        const BasicVec2<Wide> farA = surfaceB + d, farB = surfaceA - d;
        const BasicVec2<Wide> armA{select(onA, surfaceA.x, farA.x), select(onA, surfaceA.y, farA.y)};
        const BasicVec2<Wide> armB{select(onA, farB.x, surfaceB.x), select(onA, farB.y, surfaceB.y)};
        source.gap[k] = gap;
        preparePoint(block.row, block.row.points[k], linear, armA, armB, gap, Wide(invH), source.present[k]);
    }
    if (points == 2) prepareBlock(block.row, linear);
}

}  // namespace
}  // namespace tamias2d::inline TAMIAS_PRECISION
