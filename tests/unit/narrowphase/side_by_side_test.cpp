// SPDX-License-Identifier: MIT
#include "narrowphase/side_by_side.hpp"
#include "support/convex.hpp"
#include "support/same_bits.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace tamias2d {
namespace {

using test::convexOf;
using test::sameBits;

bool sameBits(Vec2 a, Vec2 b)
{
    return sameBits(a.x, b.x) && sameBits(a.y, b.y);
}

// What differs between two results, in words; empty if every bit is the same.
std::string difference(const SweptResult& a, const SweptResult& b)
{
    std::string text;
    const auto check = [&text](bool same, const char* what) {
        if (!same) text += std::string(what) + " ";
    };
    check(a.near == b.near, "near");
    check(sameBits(a.startGap, b.startGap), "startGap");
    check(sameBits(a.apart.axis.x, b.apart.axis.x) && sameBits(a.apart.axis.y, b.apart.axis.y), "axis");
    check(sameBits(a.apart.gap, b.apart.gap), "gap along the axis");
    check(a.exhausted == b.exhausted, "exhausted");
    check(a.bends == b.bends, "bends");
    check(a.manifold.atImpact == b.manifold.atImpact, "atImpact");
    check(sameBits(a.manifold.time, b.manifold.time), "time");
    check(sameBits(a.manifold.normal, b.manifold.normal), "normal");
    check(a.manifold.count == b.manifold.count, "count");
    if (!a.near || !b.near) return text;
    for (int i = 0; i < std::min(a.manifold.count, b.manifold.count); ++i) {
        const ManifoldPoint &p = a.manifold.points[i], &q = b.manifold.points[i];
        check(sameBits(p.localA, q.localA), "localA");
        check(sameBits(p.localB, q.localB), "localB");
        check(p.cornerOnA == q.cornerOnA, "cornerOnA");
        check(p.roundOnRound == q.roundOnRound, "roundOnRound");
        check(p.feature == q.feature, "feature");
    }
    return text;
}

constexpr double kStep = 1.0 / 60;

// The kernels of every width that this machine has, in turn.
const PairKernels& kernelsOf(int trial)
{
    static const std::vector<LaneWidth> widths = [] {
        std::vector<LaneWidth> has;
        for (const LaneWidth width : {LaneWidth::Bytes16, LaneWidth::Bytes32, LaneWidth::Bytes64})
            if (hasLanes(width)) has.push_back(width);
        return has;
    }();
    return pairKernels(widths[static_cast<std::size_t>(trial) % widths.size()]);
}

struct Found {
    SweptResult results[kMostPairLanes];
    std::uint32_t decided;

    Found(const PairKernels& kernels, const PairOnWay* pairs, int count)
    {
        SweptResult* at[kMostPairLanes];
        for (int i = 0; i < count; ++i) {
            results[i].near = results[i].bends = results[i].exhausted = true;  // of another pair, before
            results[i].manifold = {{1, 1}, 2, {}, 1, true};
            at[i] = results + i;
        }
        decided = kernels.collide(laneKindOf(*pairs->a, *pairs->b), pairs, count, at);
    }
    bool isDecided(int i) const { return (decided >> i & 1u) != 0; }
};

// What may be in the lanes of a kind, the first of them so that it can be nothing else.
struct Family {
    LaneKind kind;
    std::vector<Geometry> shapes;
};
const Family kBoxes{
    LaneKind::Corners4,
    {makeBox(1, 1), makeBox(1, real(0.5)), makeBox(4, real(0.1)), makeRegularPolygon(4, real(0.7))}};
const Family kTriangles{LaneKind::Corners4,
                        {makeRegularPolygon(3, real(0.7)), makeBox(2, real(0.2)), makeRegularPolygon(3, 1),
                         Segment{{real(-1.5), 0}, {real(1.5), 0}, 0}}};
const Family kHexagons{LaneKind::Corners6,
                       {makeRegularPolygon(5, real(0.6)), makeRegularPolygon(6, real(0.6)), makeBox(1, 1),
                        makeRegularPolygon(3, real(0.7)), Segment{{real(-1.5), 0}, {real(1.5), 0}, 0}}};
const Family kOctagons{LaneKind::Corners8,
                       {makeRegularPolygon(7, real(0.6)), makeRegularPolygon(8, real(0.6)), makeBox(2, 1),
                        makeRegularPolygon(5, real(0.6)), makeRegularPolygon(6, real(0.6))}};

// Two polygons that rest on, slide along or fly past each other, and every degenerate way of doing so.
struct Scene {
    Convex a, b;
    Trajectory pathA, pathB;
    real restGap = real(1e-3);

    explicit Scene(std::mt19937& random, const Family& family = kBoxes)
    {
        std::uniform_real_distribution<double> unit(-1, 1);
        const auto whole = [&] { return static_cast<double>(static_cast<int>(random() % 5)) - 2; };
        const std::vector<Geometry>& shapes = family.shapes;
        do {
            a = convexOf(shapes[random() % shapes.size()]);
            b = convexOf(shapes[random() % shapes.size()]);
        } while (laneKindOf(a, b) != family.kind);
        const bool aligned = random() % 2 == 0, still = random() % 3 == 0;
        const double size = 0.5 * (static_cast<double>(a.size) + static_cast<double>(b.size));
        // On the face or on its end, to the last digit or nearly; or anywhere.
        const double gap = random() % 4 == 0 ? 0 : 2e-3 * unit(random);
        const DVec2 offset = random() % 4 == 0 ? DVec2{2 * unit(random), 2 * unit(random)}
                                               : DVec2{0.5 * size * whole(), size + gap};
        const double quarter = 0.5 * kPi * static_cast<double>(random() % 4);
        const double turnA = aligned ? quarter : kTwoPi * unit(random),
                     turnB = aligned ? turnA : kTwoPi * unit(random);
        const auto way = [&](DVec2 place, double angle) {
            Trajectory path;
            path.position = {static_cast<real>(place.x), static_cast<real>(place.y)};
            path.angle = angle;
            path.rotation = Rot::ofAngle(angle);
            if (!still) {
                const double speeds[] = {0.05, 0.05, 0.5, 3, 30};
                const double speed = speeds[random() % 5];
                path.velocity = {static_cast<real>(speed * unit(random)),
                                 static_cast<real>(speed * unit(random))};
                path.spin = static_cast<real>(random() % 2 == 0 ? 0 : speed * unit(random));
                path.acceleration = {0, static_cast<real>(random() % 2 == 0 ? 0 : -10)};
                path.spinRate = static_cast<real>(random() % 2 == 0 ? 0 : unit(random));
            }
            path.lookAhead(static_cast<real>(kStep));
            return path;
        };
        pathA = way({}, turnA);
        pathB = way(offset, turnB);
    }
};

class PolygonsSideBySide : public testing::TestWithParam<const Family*> {};

TEST_P(PolygonsSideBySide, MeetAsEachPairAlone)
{
    TRACES("ADR5", "ADR6", "R7");
    std::mt19937 random(21);
    const real end = static_cast<real>(kStep);
    int decidedPairs = 0, touching = 0, onePoint = 0, bending = 0, pairs = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const PairKernels& kernels = kernelsOf(trial);
        const int count = 1 + static_cast<int>(random() % static_cast<unsigned>(kernels.lanes));
        std::vector<Scene> scenes;
        for (int i = 0; i < count; ++i) scenes.emplace_back(random, *GetParam());
        std::vector<SpanOfWay> ways;
        for (const Scene& s : scenes) {
            ways.emplace_back(s.pathA, end);
            ways.emplace_back(s.pathB, end);
        }
        PairOnWay polygons[kMostPairLanes];
        for (int i = 0; i < count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const Scene& s = scenes[k];
            polygons[i] = {&s.a,     &s.b, &ways[2 * k], &ways[2 * k + 1], s.pathA.position, s.pathB.position,
                           s.restGap};
        }
        const Found found(kernels, polygons, count);
        pairs += count;
        for (int i = 0; i < count; ++i) {
            if (!found.isDecided(i)) continue;
            const Scene& s = scenes[static_cast<std::size_t>(i)];
            const SweptResult alone = collideSwept({s.a, s.b, s.pathA, s.pathB, s.restGap}, 0, end);
            ASSERT_EQ(difference(found.results[i], alone), "") << "trial " << trial << ", lane " << i;
            ++decidedPairs;
            touching += alone.near ? 1 : 0;
            onePoint += alone.near && alone.manifold.count == 1 ? 1 : 0;
            bending += alone.bends ? 1 : 0;
        }
    }
    // The cases that lanes are there for do occur, and most pairs are decided.
    EXPECT_GT(decidedPairs, pairs * 6 / 10) << pairs;
    EXPECT_GT(touching, 5000);
    EXPECT_GT(onePoint, 0);  // rare where no corner stands above a face
    EXPECT_GT(bending, 50);
}

std::string nameOf(const testing::TestParamInfo<const Family*>& test)
{
    const char* const names[] = {"boxes", "triangles", "hexagons", "octagons"};
    return names[test.index];
}
INSTANTIATE_TEST_SUITE_P(Kinds, PolygonsSideBySide,
                         testing::Values(&kBoxes, &kTriangles, &kHexagons, &kOctagons), nameOf);

// A pair is decided the same way in whatever lane it stands, and whoever stands beside it.
TEST(SideBySide, BoxesAreDecidedWhoeverStandsBesideThem)
{
    TRACES("ADR6");
    std::mt19937 random(22);
    const real end = static_cast<real>(kStep);
    for (int trial = 0; trial < 3000; ++trial) {
        const Scene s(random), other(random);
        const SpanOfWay wayA(s.pathA, end), wayB(s.pathB, end), otherA(other.pathA, end),
            otherB(other.pathB, end);
        const PairOnWay pair{&s.a, &s.b, &wayA, &wayB, s.pathA.position, s.pathB.position, s.restGap};
        const PairOnWay neighbor{
            &other.a, &other.b, &otherA, &otherB, other.pathA.position, other.pathB.position, other.restGap};
        const PairKernels& kernels = kernelsOf(trial);
        const int last = kernels.lanes - 1;
        PairOnWay beside[kMostPairLanes];
        for (int i = 0; i <= last; ++i) beside[i] = i == last ? pair : neighbor;
        const Found alone(kernels, &pair, 1), among(kernels, beside, last + 1);
        ASSERT_EQ(alone.isDecided(0), among.isDecided(last)) << "trial " << trial;
        if (alone.isDecided(0)) {
            ASSERT_EQ(difference(alone.results[0], among.results[last]), "") << "trial " << trial;
        }
    }
}

// Against geometry of its own: a box that lies flat on another shares with it the overlap of two intervals.
TEST(SideBySide, BoxesThatLieFlatTouchAtTheEndsOfWhatTheyShare)
{
    TRACES("LC1", "IM3");
    std::mt19937 random(23);
    std::uniform_real_distribution<double> width(0.2, 3), shift(-2, 2), height(0.2, 2);
    const double tolerance = std::is_same_v<real, double> ? 1e-12 : 2e-6;
    for (int trial = 0; trial < 2000; ++trial) {
        const double wA = width(random), wB = width(random), hA = height(random), hB = height(random);
        const double x = shift(random);
        const double left = std::max(-wA / 2, x - wB / 2), right = std::min(wA / 2, x + wB / 2);
        if (right - left < 1e-2) continue;
        const Convex a = convexOf(makeBox(static_cast<real>(wA), static_cast<real>(hA)));
        const Convex b = convexOf(makeBox(static_cast<real>(wB), static_cast<real>(hB)));
        const double gap = 1e-3;
        Trajectory pathA, pathB;
        pathB.position = {static_cast<real>(x), static_cast<real>((hA + hB) / 2 + gap)};
        const SpanOfWay wayA(pathA, static_cast<real>(kStep)), wayB(pathB, static_cast<real>(kStep));
        const PairOnWay pair{&a, &b, &wayA, &wayB, pathA.position, pathB.position, real(1e-3)};
        const Found found(kernelsOf(trial), &pair, 1);
        const SweptResult& result = found.results[0];
        ASSERT_TRUE(found.isDecided(0) && result.near) << "trial " << trial;
        ASSERT_EQ(result.manifold.count, 2) << "trial " << trial;
        EXPECT_NEAR(result.manifold.normal.y, 1, tolerance);
        EXPECT_NEAR(result.startGap, gap, tolerance);
        double ends[2];
        for (int i = 0; i < 2; ++i) {
            ends[i] = static_cast<double>(result.manifold.points[i].localA.x);
            EXPECT_NEAR(result.manifold.points[i].localA.y, hA / 2, tolerance);
            EXPECT_NEAR(result.manifold.points[i].localB.y, -hB / 2, tolerance);
        }
        EXPECT_NEAR(std::min(ends[0], ends[1]), left, tolerance) << "trial " << trial;
        EXPECT_NEAR(std::max(ends[0], ends[1]), right, tolerance) << "trial " << trial;
    }
}

TEST(SideBySide, DiscsMeetAsEachPairAlone)
{
    TRACES("ADR5", "ADR6", "R7");
    std::mt19937 random(24);
    std::uniform_real_distribution<double> unit(-1, 1);
    const real end = static_cast<real>(kStep);
    int pairs = 0, decidedPairs = 0, touching = 0, overlapping = 0, atEnd = 0;
    for (int trial = 0; trial < 40000; ++trial) {
        const double rA = 0.1 + 0.4 * std::abs(unit(random)), rB = random() % 2 == 0 ? rA : 0.3;
        const Convex a = convexOf(Circle{{}, static_cast<real>(rA)}),
                     b = convexOf(Circle{{}, static_cast<real>(rB)});
        const double phi =
            random() % 4 == 0 ? 0.5 * kPi * static_cast<double>(random() % 4) : kTwoPi * unit(random);
        const double spread = random() % 4 == 0 ? 0.02 : 3e-3;
        const double distance = random() % 16 == 0 ? 0 : rA + rB + spread * unit(random);
        Trajectory pathA, pathB;
        pathB.position = {static_cast<real>(distance * std::cos(phi)),
                          static_cast<real>(distance * std::sin(phi))};
        const double speeds[] = {0, 0.05, 1, 30};
        for (Trajectory* path : {&pathA, &pathB}) {
            const double speed = speeds[random() % 4];
            path->velocity = {static_cast<real>(speed * unit(random)),
                              static_cast<real>(speed * unit(random))};
            path->spin = static_cast<real>(speed * unit(random));
            path->acceleration = {0, static_cast<real>(random() % 2 == 0 ? 0 : -10)};
        }
        const SpanOfWay wayA(pathA, end), wayB(pathB, end);
        const PairOnWay pair{&a, &b, &wayA, &wayB, pathA.position, pathB.position, real(1e-3)};
        const Found found(kernelsOf(trial), &pair, 1);
        const SweptResult alone = collideSwept({a, b, pathA, pathB, real(1e-3)}, 0, end);
        ++pairs;
        if (!found.isDecided(0)) continue;
        ASSERT_EQ(difference(found.results[0], alone), "") << "trial " << trial;
        ++decidedPairs;
        touching += alone.near ? 1 : 0;
        overlapping += alone.near && alone.startGap < 0 ? 1 : 0;
        atEnd += alone.near && alone.startGap > real(3e-3) ? 1 : 0;
    }
    EXPECT_GT(decidedPairs, pairs * 6 / 10) << pairs;
    EXPECT_GT(touching, 10000);
    EXPECT_GT(overlapping, 1000);
    EXPECT_GT(atEnd, 10);
}

}  // namespace
}  // namespace tamias2d
