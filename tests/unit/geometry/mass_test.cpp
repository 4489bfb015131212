// SPDX-License-Identifier: MIT
#include "support/traces.hpp"
#include "unit/geometry/geometry_samples.hpp"

#include <tamias2d/base/error.hpp>
#include <tamias2d/geometry/mass.hpp>
#include <tamias2d/math/scalar.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace tamias2d::test {
namespace {

void expectRelative(double given, double expected, const char* what)
{
    EXPECT_NEAR(given, expected, kRealTolerance * std::abs(expected)) << what;
}

TEST(Mass, OfADiscIsTheTextbooks)
{
    TRACES("DD1", "DD14");
    const MassProperties m = massProperties(Circle{vec(3, -2), 2}, real(0.5));
    expectRelative(m.mass, 0.5 * kPi * 4, "mass");
    expectRelative(m.inertia, m.mass * 4 / 2, "inertia");
    EXPECT_EQ(m.center, vec(3, -2));
}

TEST(Mass, OfABoxIsTheTextbooks)
{
    TRACES("DD1", "DD14");
    const MassProperties m = massProperties(makeBox(2, 3), 5);
    expectRelative(m.mass, 30, "mass");
    expectRelative(m.inertia, 30 * (4 + 9) / 12.0, "inertia");
    EXPECT_EQ(m.center, vec(0, 0));
}

TEST(Mass, OfATriangleIsTheTextbooks)
{
    TRACES("DD1", "DD14");
    const std::vector<Vec2> corners = {vec(0, 0), vec(3, 0), vec(0, 6)};
    const MassProperties m = massProperties(makePolygon(corners), 1);
    expectRelative(m.mass, 9, "mass");
    expectRelative(m.center.x, 1, "center x");
    expectRelative(m.center.y, 2, "center y");
    expectRelative(m.inertia, 9 * (9 + 36) / 18.0, "inertia");  // m (b^2 + h^2) / 18 with a right angle
}

// A box of l x 2r and two half discs, each with its center 4 r / (3 pi) beyond the end.
TEST(Mass, OfACapsuleIsABoxAndTwoHalfDiscs)
{
    TRACES("DD1", "DD14");
    const double l = 2, r = 0.5, box = l * 2 * r, disc = kPi * r * r, reach = 4 * r / (3 * kPi);
    const double halves = disc * (r * r / 2 - reach * reach + (l / 2 + reach) * (l / 2 + reach));
    const double inertia = box * (l * l + 4 * r * r) / 12 + halves;
    for (const Geometry& shape : {Geometry(Capsule{vec(1, 1), vec(3, 1), real(0.5)}),
                                  Geometry(Segment{vec(2, 0), vec(2, 2), real(0.5)})}) {
        const MassProperties m = massProperties(shape, 1);
        expectRelative(m.mass, box + disc, "mass");
        expectRelative(m.inertia, inertia, "inertia");
        EXPECT_EQ(m.center, vec(2, 1));
    }
}

// A square rounded by r, as a cross of boxes and one disc cut into four quarters.
TEST(Mass, OfARoundedSquareIsACrossAndFourQuarterDiscs)
{
    TRACES("DD1", "DD14");
    const double a = 1, r = 0.25, reach = 4 * r / (3 * kPi);  // of a quarter's center from both sides
    const double quarter = kPi * r * r / 4;
    const double own = quarter * (r * r / 2 - 2 * reach * reach),
                 away = 2 * (a / 2 + reach) * (a / 2 + reach);
    const double side = a * r, sideAway = (a / 2 + r / 2) * (a / 2 + r / 2);
    const double inertia =
        a * a * (2 * a * a) / 12 + 4 * side * ((a * a + r * r) / 12 + sideAway) + 4 * (own + quarter * away);
    const MassProperties m = massProperties(makeBox(1, 1, real(0.25)), 1);
    expectRelative(m.mass, a * a + 4 * side + 4 * quarter, "mass");
    expectRelative(m.inertia, inertia, "inertia");
    EXPECT_EQ(m.center, vec(0, 0)) << "rounding must not tilt a symmetric shape";
}

TEST(Mass, ALineWithoutRoundingHasNone)
{
    TRACES("DD1");
    const MassProperties m = massProperties(Segment{vec(0, 0), vec(2, 4), 0}, 7);
    EXPECT_EQ(m.mass, 0);
    EXPECT_EQ(m.inertia, 0);
    EXPECT_EQ(m.center, vec(1, 2));
}

// Strips: along y the extent of a convex shape is found by bisection of the distance, so all that
// the sum shares with the library is the definition of the shapes.
TEST(Mass, OfEverySampleAgreesWithNumericIntegration)
{
    TRACES("DD1", "DD14");
    constexpr int kStrips = 6000;  // upright sides of the samples fall between two strips
    constexpr double kHalf = 3, kWidth = 2 * kHalf / kStrips;
    for (const Geometry& shape : sampleShapes()) {
        const auto inside = [&](double x, double y) { return distanceFrom(shape, {x, y}) <= 0; };
        const auto end = [&](double x, double in, double out) {
            for (int i = 0; i < 40; ++i) (inside(x, (in + out) / 2) ? in : out) = (in + out) / 2;
            return in;
        };
        double area0 = 0, momentX = 0, momentY = 0, second = 0;
        for (int i = 0; i < kStrips; ++i) {
            const double x = -kHalf + (i + 0.5) * kWidth;
            // The distance along the strip is convex: its least is in the shape if anything is.
            double low = -kHalf, high = kHalf;
            for (int k = 0; k < 80; ++k) {
                const double a = low + (high - low) / 3, b = high - (high - low) / 3;
                if (distanceFrom(shape, {x, a}) < distanceFrom(shape, {x, b}))
                    high = b;
                else
                    low = a;
            }
            if (!inside(x, low)) continue;
            const double y0 = end(x, low, -kHalf), y1 = end(x, low, kHalf);
            area0 += (y1 - y0) * kWidth;
            momentX += x * (y1 - y0) * kWidth;
            momentY += (y1 * y1 - y0 * y0) / 2 * kWidth;
            second += (x * x * (y1 - y0) + (y1 * y1 * y1 - y0 * y0 * y0) / 3) * kWidth;
        }
        const MassProperties m = massProperties(shape, 1);
        EXPECT_NEAR(double(area(shape)), area0, 1e-4) << "kind " << shape.index();
        if (area0 < 1e-6) continue;
        const double x = momentX / area0, y = momentY / area0;
        EXPECT_NEAR(double(m.center.x), x, 1e-4) << "kind " << shape.index();
        EXPECT_NEAR(double(m.center.y), y, 1e-4) << "kind " << shape.index();
        EXPECT_NEAR(double(m.inertia), second - area0 * (x * x + y * y), 3e-4) << "kind " << shape.index();
        EXPECT_EQ(centroid(shape), m.center);
    }
}

TEST(Mass, OfAPolygonDoesNotDependOnWhereItsFrameIs)
{
    TRACES("DD1", "DD14");
    const std::vector<Vec2> near = {vec(0, 0), vec(2, 0), vec(1, 1)};
    const std::vector<Vec2> far = {vec(4096, -4096), vec(4098, -4096), vec(4097, -4095)};
    const MassProperties a = massProperties(makePolygon(near, real(0.25)), 1);
    const MassProperties b = massProperties(makePolygon(far, real(0.25)), 1);
    expectRelative(b.mass, a.mass, "mass");
    expectRelative(b.inertia, a.inertia, "inertia");
    expectRelative(b.center.x, 4096 + double(a.center.x), "center x");
}

TEST(Mass, RefusesWhatIsNoShapeAndBadDensities)
{
    TRACES("R4");
    EXPECT_THROW(massProperties(Circle{{}, -1}, 1), InputError);
    EXPECT_THROW(area(Polygon{}), InputError);
    EXPECT_THROW(massProperties(Circle{}, -1), InputError);
    EXPECT_THROW(massProperties(Circle{}, std::numeric_limits<real>::quiet_NaN()), InputError);
    EXPECT_THROW(massProperties(Circle{}, std::numeric_limits<real>::infinity()), InputError);
}

}  // namespace
}  // namespace tamias2d::test
