// SPDX-License-Identifier: MIT
// Mass, center and moment of inertia: from shapes and densities against closed forms, for several shapes by
// the parallel axes, by hand, and back again [DD1, DD14].
#include "support/build.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace tamias2d {
namespace {

using namespace test;

const double kSumTolerance = byPrecision(1e-13, 2e-6);  // relative; a few roundings of sums of a few terms

void expectNear(double a, double b, double scale, const char* what)
{
    EXPECT_NEAR(a, b, kSumTolerance * scale) << what;
}

struct Expected {
    const char* name;
    Geometry geometry;
    double area;     // [m^2]
    DVec2 center;    // [m]
    double inertia;  // about the center, for a density of 1 kg/m^2   [kg*m^2]
};

// A stadium: a rectangle and two half discs, whose own centers lie 4r/(3 pi) beyond the rectangle's ends.
Expected capsuleOf(double l, double r)
{
    const double rectangle = 2 * r * l, ends = kPi * r * r, d = 4 * r / (3 * kPi);
    const double own = ends * (r * r / 2 - d * d), arm = l / 2 + d;
    return {"capsule",
            Capsule{vec(-l / 2, 0), vec(l / 2, 0), toReal(r)},
            rectangle + ends,
            {},
            rectangle * (l * l + 4 * r * r) / 12 + own + ends * arm * arm};
}

// A rounded box: the core, four strips along its sides and four quarter discs at its corners.
Expected roundedBoxOf(double w, double h, double r)
{
    const double d = 4 * r / (3 * kPi), x = w / 2 + d, y = h / 2 + d, corners = kPi * r * r;
    const auto strip = [](double along, double across, double distance) {
        const double m = along * across;
        return 2 * (m * (along * along + across * across) / 12 + m * distance * distance);
    };
    return {"rounded box",
            makeBox(toReal(w), toReal(h), toReal(r)),
            w * h + 2 * r * (w + h) + corners,
            {},
            w * h * (w * w + h * h) / 12 + strip(w, r, h / 2 + r / 2) + strip(h, r, w / 2 + r / 2) +
                corners * (r * r / 2 - 2 * d * d + x * x + y * y)};
}

std::vector<Expected> closedForms()
{
    const std::vector<Vec2> triangle = {vec(0, 0), vec(3, 0), vec(0, 1.5)};
    return {
        {"disc", Circle{{}, 2}, kPi * 4, {}, kPi * 4 * 4 / 2},
        {"disc off its frame", Circle{vec(3, -1), 2}, kPi * 4, {3, -1}, kPi * 4 * 4 / 2},
        {"box", makeBox(2, 3), 6, {}, 6 * (4.0 + 9.0) / 12},
        {"hexagon", makeRegularPolygon(6, 1), 1.5 * std::sqrt(3.0), {}, 1.5 * std::sqrt(3.0) * 5 / 12},
        {"right triangle", makePolygon(triangle), 2.25, {1, 0.5}, 2.25 * (9 + 2.25) / 18},
        {"line", Segment{vec(-1, 0), vec(1, 0)}, 0, {}, 0},
        capsuleOf(2, 0.5),
        roundedBoxOf(1, 2, 0.25),
    };
}

TEST(Mass, OfEveryShapeIsItsClosedForm)
{
    TRACES("DD1", "DD14", "R2");
    for (const Expected& e : closedForms()) {
        const double density = 2.5;
        const MassProperties m = massProperties(e.geometry, toReal(density));
        expectNear(area(e.geometry), e.area, e.area, e.name);
        expectNear(m.mass, density * e.area, density * e.area, e.name);
        expectNear(m.inertia, density * e.inertia, density * e.inertia, e.name);
        expectNear(m.center.x, e.center.x, 3, e.name);
        expectNear(m.center.y, e.center.y, 3, e.name);
        expectNear(centroid(e.geometry).x, e.center.x, 3, e.name);
        expectNear(centroid(e.geometry).y, e.center.y, 3, e.name);
    }
}

TEST(Mass, OfABodyIsThatOfItsShapeMovedByItsOffset)
{
    TRACES("DD1", "DD14", "R2");
    for (const Expected& e : closedForms()) {
        if (e.area == 0) continue;
        World world;
        Body body = world.createBody();
        ShapeDef def;
        def.geometry = e.geometry;
        def.offset = vec(4, -2);
        def.angle = 1.1;
        def.density = 3;
        body.createShape(def);
        const double c = std::cos(1.1), s = std::sin(1.1);
        expectNear(body.mass(), 3 * e.area, 3 * e.area, e.name);
        expectNear(body.inertia(), 3 * e.inertia, 3 * e.inertia, e.name);
        expectNear(body.localCenter().x, 4 + c * e.center.x - s * e.center.y, 5, e.name);
        expectNear(body.localCenter().y, -2 + s * e.center.x + c * e.center.y, 5, e.name);
    }
}

TEST(Mass, OfTwoShapesFollowsTheParallelAxes)
{
    TRACES("DD1", "DD14", "R2");
    World world;
    Body body = world.createBody({.position = {10, 20}, .angle = kPi / 2});
    body.createShape({.geometry = Circle{{}, 1}, .offset = vec(-2, 0), .density = 1});
    body.createShape({.geometry = makeBox(2, 2), .offset = vec(3, 0), .density = 2});
    const double disc = kPi, box = 8, mass = disc + box, x = (-2 * disc + 3 * box) / mass;
    expectNear(body.mass(), mass, mass, "mass");
    expectNear(body.localCenter().x, x, 3, "center");
    expectNear(body.localCenter().y, 0, 3, "center");
    const double inertia = disc / 2 + disc * (x + 2) * (x + 2) + box * 8 / 12 + box * (3 - x) * (3 - x);
    expectNear(body.inertia(), inertia, inertia, "inertia");
    // A quarter turn puts the center above the origin.
    expectNear(body.centerOfMass().x, 10, 20, "center in the world");
    expectNear(body.centerOfMass().y, 20 + x, 20, "center in the world");
}

TEST(Mass, FollowsShapesAsTheyComeGoAndChange)
{
    TRACES("DD1", "DD14", "R2");
    World world;
    Body body = world.createBody();
    Shape left = body.createShape({.geometry = makeBox(1, 1), .offset = vec(-1, 0)});
    Shape right = body.createShape({.geometry = makeBox(1, 1), .offset = vec(1, 0)});
    expectNear(body.mass(), 2, 2, "two boxes");
    expectNear(body.inertia(), 2 * (1.0 / 6 + 1), 2, "two boxes");
    right.setDensity(3);
    expectNear(body.mass(), 4, 4, "the right one heavier");
    expectNear(body.localCenter().x, 0.5, 1, "the right one heavier");
    ShapeDef larger = left.definition();
    larger.geometry = makeBox(1, 3);
    left.redefine(larger);
    expectNear(body.mass(), 6, 6, "the left one larger");
    expectNear(body.localCenter().x, 0, 1, "the left one larger");
    left.destroy();
    expectNear(body.mass(), 3, 3, "the right one alone");
    expectNear(body.localCenter().x, 1, 1, "the right one alone");
    expectNear(body.inertia(), 3 * 1.0 / 6, 1, "the right one alone");
}

TEST(Mass, AShapeWithoutDensityWeighsNothing)
{
    TRACES("DD1", "DC-m");
    World world;
    Body body = addBox(world, {}, 1, 1);
    body.createShape({.geometry = makeBox(5, 5), .offset = vec(10, 0), .density = 0});
    body.createShape({.geometry = Segment{vec(0, 5), vec(9, 5)}});
    expectNear(body.mass(), 1, 1, "mass");
    expectNear(body.localCenter().x, 0, 1, "center");
    expectNear(body.inertia(), 1.0 / 6, 1, "inertia");
}

TEST(Mass, SetByHandStaysUntilItIsReset)
{
    TRACES("R2", "DD1", "DD14", "DC-m", "DC-I");
    World world;
    Body body = addBox(world, {1, 2}, 2, 2);
    EXPECT_FALSE(body.definition().mass.has_value());
    body.setMass({10, vec(0.5, 0.25), 7});
    body.createShape({.geometry = Circle{}, .density = 100});
    EXPECT_EQ(body.mass(), real(10));
    EXPECT_EQ(body.inertia(), real(7));
    EXPECT_EQ(body.localCenter(), vec(0.5, 0.25));
    EXPECT_EQ(body.centerOfMass(), (Position{1.5, 2.25}));
    ASSERT_TRUE(body.definition().mass.has_value());
    EXPECT_EQ(body.definition().mass->mass, real(10));
    body.shapes().back().destroy();
    EXPECT_EQ(body.mass(), real(10));
    body.resetMass();
    EXPECT_FALSE(body.definition().mass.has_value());
    expectNear(body.mass(), 4, 4, "from the box again");
    expectNear(body.inertia(), 4 * 8.0 / 12, 3, "from the box again");
    expectNear(body.localCenter().x, 0, 1, "from the box again");
}

TEST(Mass, NoInertiaMeansThatNothingTurnsTheBody)
{
    TRACES("DC-I", "DD14");
    World world(weightless());
    Body body = world.createBody({.mass = MassProperties{2, {}, 0}});
    body.createShape({.geometry = makeBox(1, 1)});
    EXPECT_EQ(body.inertia(), real(0));
    body.applyTorque(50);
    body.applyAngularImpulse(50);
    body.applyImpulse(vec(0, 2), {0.5, 0});
    world.step();
    EXPECT_EQ(body.angularVelocity(), real(0));
    EXPECT_EQ(body.angle(), 0.0);
    expectNear(body.linearVelocity().y, 1, 1, "the impulse still pushes");
}

TEST(Mass, OfBodiesThatNothingPushesIsToldAsZero)
{
    TRACES("DC-m");
    World world;
    for (const BodyType type : {BodyType::Static, BodyType::Kinematic}) {
        Body body = addBox(world, {}, 1, 1, {.type = type});
        EXPECT_EQ(body.mass(), real(0));
        EXPECT_EQ(body.inertia(), real(0));
        body.setType(BodyType::Dynamic);
        expectNear(body.mass(), 1, 1, "once it is dynamic");
        expectNear(body.inertia(), 1.0 / 6, 1, "once it is dynamic");
    }
}

// Its matter goes on as it went; the center of mass is elsewhere now and has the velocity of that place.
TEST(Mass, ANewPieceLeavesTheBodysOriginAndMotionAlone)
{
    TRACES("R2", "DD1", "DD9");
    World world(weightless());
    Body body = addBox(world, {3, 4}, 1, 1, {.velocity = vec(1, 2), .spin = 3, .angle = kPi / 2});
    const Vec2 before = body.velocityAt({5, 6});
    body.createShape({.geometry = makeBox(1, 1), .offset = vec(4, 0)});
    expectNear(body.position().x, 3, 8, "origin");
    expectNear(body.position().y, 4, 8, "origin");
    expectNear(body.centerOfMass().x, 3, 8, "center");
    expectNear(body.centerOfMass().y, 6, 8, "center");
    expectNear(body.velocityAt({5, 6}).x, before.x, 20, "velocity of the matter");
    expectNear(body.velocityAt({5, 6}).y, before.y, 20, "velocity of the matter");
    expectNear(body.linearVelocity().x, 1 - 3 * 2, 20, "velocity of the new center");
    expectNear(body.linearVelocity().y, 2, 20, "velocity of the new center");
}

}  // namespace
}  // namespace tamias2d
