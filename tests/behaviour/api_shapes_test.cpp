// SPDX-License-Identifier: MIT
// Shapes: their definitions come back as given, they can change under a running world, and they know where
// they are.
#include "support/build.hpp"
#include "support/describe.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

using namespace test;

std::string textOf(const ShapeDef& def)
{
    std::ostringstream out;
    out << std::hexfloat;
    write(out, def);
    return out.str();
}
std::string textOf(const BodyDef& def)
{
    std::ostringstream out;
    out << std::hexfloat;
    write(out, def);
    return out.str();
}

std::vector<ShapeDef> variedShapes()
{
    ShapeDef def;
    def.offset = vec(0.3, -0.7);
    def.angle = 0.4;
    def.density = toReal(2.5);
    def.material = {.friction = toReal(0.1),
                    .restitution = toReal(0.9),
                    .rollingResistance = toReal(0.01),
                    .surfaceSpeed = -3,
                    .frictionMixing = MixingRule::Minimum,
                    .restitutionMixing = MixingRule::Average};
    def.filter = {.category = 8, .mask = 15, .group = -2};
    def.userData = 99;
    std::vector<ShapeDef> all;
    for (const Geometry& geometry :
         {Geometry(Circle{vec(0.1, 0.2), toReal(0.3)}), Geometry(Capsule{vec(-1, 0), vec(1, 2), toReal(0.3)}),
          Geometry(Segment{vec(-1, 0), vec(1, 0), toReal(0.05)}), Geometry(makeBox(1, 2, toReal(0.1))),
          Geometry(makeRegularPolygon(16, 1))}) {
        def.geometry = geometry;
        all.push_back(def);
    }
    return all;
}

TEST(Definitions, OfShapesComeBackAsGiven)
{
    TRACES("R2", "R3");
    World world;
    Body body = world.createBody();
    for (const ShapeDef& def : variedShapes()) {
        Shape shape = body.createShape(def);
        EXPECT_EQ(textOf(shape.definition()), textOf(def));
        EXPECT_EQ(shape.material(), def.material);
        EXPECT_EQ(shape.filter(), def.filter);
        EXPECT_EQ(shape.density(), def.density);
        EXPECT_EQ(shape.userData(), def.userData);
    }
    EXPECT_EQ(body.shapes().size(), 5u);
}

TEST(Definitions, OfBodiesComeBackAsGiven)
{
    TRACES("R2", "DC-phi");
    BodyDef def;
    def.type = BodyType::Dynamic;
    def.position = {1e6, -2};
    def.angle = 3;
    def.linearVelocity = vec(1, 2);
    def.angularVelocity = -3;
    def.mass = MassProperties{5, vec(0.1, 0.2), 6};
    def.linearDamping = toReal(0.1);
    def.angularDamping = toReal(0.2);
    def.gravityScale = -1;
    def.gravity = vec(3, 4);
    def.lockX = def.lockRotation = true;
    def.enabled = false;
    def.name = "a \"named\" body";
    def.userData = 77;
    World world;
    BodyDef made = world.createBody(def).definition();
    // A world keeps centers of mass; a position that is not one comes back to the last bit but one.
    EXPECT_NEAR(made.position.x, def.position.x, 4e-16 * 1e6);
    EXPECT_NEAR(made.position.y, def.position.y, 4e-16 * 2);
    made.position = def.position;
    EXPECT_EQ(textOf(made), textOf(def));
    EXPECT_EQ(textOf(world.createBody().definition()), textOf(BodyDef{}));
    const BodyDef plain{.position = {0.1, 1e8 + 0.1}, .angle = 1.1};
    EXPECT_EQ(textOf(world.createBody(plain).definition()), textOf(plain));
    def.angle = 3 + 2 * kTwoPi;
    EXPECT_NEAR(world.createBody(def).definition().angle, 3, 1e-14);
}

TEST(Definitions, MakeATwinWorld)
{
    TRACES("R1", "R2");
    WorldDef worldDef = withGravity(1, -5);
    worldDef.tuning.restGap = toReal(0.002);
    World world(worldDef);
    Body body =
        world.createBody({.position = {1, 2}, .angle = 0.5, .linearVelocity = vec(3, 1), .name = "first"});
    for (const ShapeDef& def : variedShapes()) body.createShape(def);
    addGround(world, -5);
    runSeconds(world, 0.25);

    World twin(world.definition());
    for (const BodyId id : world.bodies()) {
        Body copy = twin.createBody(world.body(id).definition());
        for (const Shape& shape : world.body(id).shapes()) copy.createShape(shape.definition());
    }
    Body second = *twin.findBody("first");
    EXPECT_EQ(textOf(second.definition()), textOf(body.definition()));
    EXPECT_EQ(second.mass(), body.mass());
    runSeconds(world, 0.25);
    runSeconds(twin, 0.25);
    const double tolerance = byPrecision(1e-12, 1e-5);
    EXPECT_NEAR(second.position().x, body.position().x, tolerance);
    EXPECT_NEAR(second.position().y, body.position().y, tolerance);
    EXPECT_NEAR(second.angle(), body.angle(), tolerance);
}

TEST(Geometry, ThatGrowsUnderABodyPushesItUp)
{
    TRACES("R2", "R7");
    World world;
    addGround(world);
    Body box = addBox(world, {0, 0.501}, 1, 1);
    runSeconds(world, 0.2);
    Shape shape = box.shapes().front();
    ShapeDef def = shape.definition();
    def.geometry = makeBox(toReal(1.2), toReal(1.2));
    shape.redefine(def);
    EXPECT_NEAR(box.mass(), 1.44, 1e-6);
    const ShapeId id = shape.id();
    runSeconds(world, 3);
    EXPECT_EQ(box.shapes().front().id(), id) << "it is still the same shape";
    EXPECT_NEAR(box.position().y, 0.601, 0.005);
    EXPECT_LT(length(velocityOf(box)), 0.01);
}

TEST(Geometry, MayChangeItsKindInFlight)
{
    TRACES("R2");
    World world;
    Body ground = addGround(world);
    Body body = addBox(world, {0, 3}, 1, 1);
    Shape shape = body.shapes().front();
    ShapeDef def = shape.definition();
    int kind = 0;
    for (const ShapeDef& varied : variedShapes()) {
        def.geometry = varied.geometry;
        shape.redefine(def);
        runSeconds(world, 0.1);
        EXPECT_EQ(shape.definition().geometry.index(), varied.geometry.index()) << "kind " << kind++;
    }
    runSeconds(world, 5);
    EXPECT_TRUE(world.touching(body.id(), ground.id()));
    EXPECT_LT(length(velocityOf(body)), 0.05);
}

TEST(Materials, CanChangeUnderARestingBody)
{
    TRACES("R3");
    // On a slope of 20 degrees: it holds with friction 0.6 and slides with 0.1.
    const double angle = 20 * kPi / 180, g = 9.81;
    World world(withGravity(-g * std::sin(angle), -g * std::cos(angle)));
    Body ground = addGround(world, 0, 1000);
    Body box = addBox(world, {0, 0.501}, 1, 1);
    runSeconds(world, 1);
    EXPECT_NEAR(box.position().x, 0, 2e-3);
    Material ice = box.shapes().front().material();
    ice.friction = toReal(0.1);
    box.shapes().front().setMaterial(ice);
    ground.shapes().front().setMaterial(ice);
    const double x = box.position().x;
    runSeconds(world, 2);
    const double a = g * (std::sin(angle) - 0.1 * std::cos(angle));
    EXPECT_NEAR(box.position().x - x, -a * 4 / 2, 0.01 * a * 2);
}

TEST(Shapes, KnowWhereTheyAre)
{
    TRACES("R7", "T5");
    World world;
    Body body = addBox(world, {10, 20}, 2, 4, {.angle = kPi / 2});
    Shape box = body.shapes().front();
    const Aabb bounds = box.bounds();
    const double tolerance = byPrecision(1e-12, 1e-5);
    EXPECT_NEAR(bounds.lower.x, 8, tolerance);
    EXPECT_NEAR(bounds.lower.y, 19, tolerance);
    EXPECT_NEAR(bounds.upper.x, 12, tolerance);
    EXPECT_NEAR(bounds.upper.y, 21, tolerance);
    EXPECT_TRUE(box.contains({11.9, 20.9}));
    EXPECT_FALSE(box.contains({11.9, 21.1}));
    Shape disc = body.createShape({.geometry = Circle{{}, 1}, .offset = vec(3, 0)});
    EXPECT_NEAR(disc.bounds().lower.y, 22, tolerance);
    EXPECT_TRUE(disc.contains({10, 23})) << "the offset turns with the body";
    body.setTransform({0, 0}, 0);
    EXPECT_TRUE(disc.contains({3, 0}));
    EXPECT_NEAR(disc.bounds().upper.x, 4, tolerance);
}

TEST(Shapes, HoldTheirBorder)
{
    TRACES("T5");
    EXPECT_TRUE(containsPoint(Circle{{}, 1}, vec(1, 0)));
    EXPECT_TRUE(containsPoint(makeBox(2, 2), vec(1, 1)));
    EXPECT_TRUE(containsPoint(makeBox(2, 2), vec(-1, 0.3)));
    EXPECT_FALSE(containsPoint(makeBox(2, 2), vec(1.001, 0)));
    EXPECT_TRUE(containsPoint(makeBox(2, 2, toReal(0.5)), vec(1.5, 0)));
    EXPECT_FALSE(containsPoint(makeBox(2, 2, toReal(0.5)), vec(1.45, 1.45))) << "the corner is round";
    EXPECT_TRUE(containsPoint(Capsule{vec(-1, 0), vec(1, 0), toReal(0.5)}, vec(1.5, 0)));
    EXPECT_FALSE(containsPoint(Capsule{vec(-1, 0), vec(1, 0), toReal(0.5)}, vec(1.4, 0.4)));
    EXPECT_TRUE(containsPoint(Segment{vec(-1, 0), vec(1, 0)}, vec(0.5, 0)));
    EXPECT_FALSE(containsPoint(Segment{vec(-1, 0), vec(1, 0)}, vec(0.5, 0.01)));
    EXPECT_TRUE(containsPoint(Segment{vec(-1, 0), vec(1, 0), toReal(0.1)}, vec(0.5, 0.09)));
}

// A1: whatever happens to it, a body keeps its shape, mass and inertia.
TEST(Shapes, AreRigid)
{
    TRACES("A1", "A2");
    World world;
    addGround(world, 0, 100, {.restitution = 0.9});
    Body box = addBox(world, {0, 5}, 1, 1, {.velocity = vec(30, -100), .spin = 50, .restitution = 0.9});
    const std::string shape = textOf(box.shapes().front().definition());
    const real mass = box.mass(), inertia = box.inertia();
    const std::size_t impacts = runSeconds(world, 2).impacts;
    EXPECT_GT(impacts, 0u);
    EXPECT_EQ(textOf(box.shapes().front().definition()), shape);
    EXPECT_EQ(box.mass(), mass);
    EXPECT_EQ(box.inertia(), inertia);
    const Transform t = box.transform();
    EXPECT_NEAR(length(toWorld(t, vec(0.5, 0.5)) - toWorld(t, vec(-0.5, -0.5))), std::sqrt(2.0), 1e-6);
}

}  // namespace
}  // namespace tamias2d
