// SPDX-License-Identifier: MIT
// Every field of ShapeDef, every call of Shape, every maker of geometry: wrong values are refused by name and
// degenerate polygons are explained [R4].
#include "support/refusals.hpp"
#include "support/traces.hpp"

namespace tamias2d {
namespace {

using namespace test;

Polygon rawPolygon(std::initializer_list<Vec2> points)
{
    Polygon polygon;
    for (const Vec2 p : points) polygon.vertices[static_cast<std::size_t>(polygon.count++)] = p;
    return polygon;
}

Polygon unitBox()
{
    return rawPolygon({vec(-0.5, -0.5), vec(0.5, -0.5), vec(0.5, 0.5), vec(-0.5, 0.5)});
}

const std::vector<BadNumber<Material>> kMaterialFields = {
    {"restitution", kNoRestitution, [](Material& m, double x) { m.restitution = toReal(x); }},
    {"friction", kNegative, [](Material& m, double x) { m.friction = toReal(x); }},
    {"rollingResistance", kNegative, [](Material& m, double x) { m.rollingResistance = toReal(x); }},
    {"surfaceSpeed", kNotFinite, [](Material& m, double x) { m.surfaceSpeed = toReal(x); }},
    {"frictionMixing",
     {77},
     [](Material& m, double x) { m.frictionMixing = static_cast<MixingRule>(static_cast<int>(x)); }},
    {"restitutionMixing",
     {77},
     [](Material& m, double x) { m.restitutionMixing = static_cast<MixingRule>(static_cast<int>(x)); }},
};

const std::vector<BadNumber<ShapeDef>> kShapeDefFields = {
    {"offset", kNotFinite, [](ShapeDef& d, double x) { d.offset.x = toReal(x); }},
    {"offset", kNotFinite, [](ShapeDef& d, double x) { d.offset.y = toReal(x); }},
    {"angle", kNotFinite, [](ShapeDef& d, double x) { d.angle = x; }},
    {"density", kNegative, [](ShapeDef& d, double x) { d.density = toReal(x); }},
    {"radius", kNoSize, [](ShapeDef& d, double x) { d.geometry = Circle{{}, toReal(x)}; }},
    {"center", kNotFinite, [](ShapeDef& d, double x) { d.geometry = Circle{vec(x, 0), 1}; }},
    {"radius", kNoSize,
     [](ShapeDef& d, double x) { d.geometry = Capsule{vec(-1, 0), vec(1, 0), toReal(x)}; }},
    {"geometry", kNotFinite, [](ShapeDef& d, double x) { d.geometry = Capsule{vec(x, 0), vec(1, 0), 1}; }},
    {"geometry", kNotFinite, [](ShapeDef& d, double x) { d.geometry = Capsule{vec(-1, 0), vec(1, x), 1}; }},
    {"geometry", {0, 1e-9, 3e6}, [](ShapeDef& d, double x) { d.geometry = Capsule{{}, vec(x, 0), 1}; }},
    {"radius", kNoRounding,
     [](ShapeDef& d, double x) { d.geometry = Segment{vec(-1, 0), vec(1, 0), toReal(x)}; }},
    {"geometry", kNotFinite, [](ShapeDef& d, double x) { d.geometry = Segment{vec(0, x), vec(1, 0)}; }},
    {"geometry", {0, 1e-9, 3e6}, [](ShapeDef& d, double x) { d.geometry = Segment{{}, vec(x, 0)}; }},
    {"radius", kNoRounding,
     [](ShapeDef& d, double x) {
         Polygon box = unitBox();
         box.radius = toReal(x);
         d.geometry = box;
     }},
    {"vertices", kNotFinite,
     [](ShapeDef& d, double x) {
         Polygon box = unitBox();
         box.vertices[2].y = toReal(x);
         d.geometry = box;
     }},
    {"count",
     {-2147483648.0, -1, 0, 1, 2, 17, 1000, 2147483647.0},
     [](ShapeDef& d, double x) {
         Polygon box = unitBox();
         box.count = static_cast<int>(x);
         d.geometry = box;
     }},
};

TEST(BadInput, EveryFieldOfAShapeDefinitionIsChecked)
{
    TRACES("R4", "DC-L");
    Everything all;
    for (const auto& entry : kShapeDefFields) {
        for (const double value : entry.values) {
            ShapeDef def;
            entry.put(def, value);
            expectRefused(all, "createShape, " + caseName(entry, value), entry.field,
                          [&] { all.box.createShape(def); });
            expectRefused(all, "redefine, " + caseName(entry, value), entry.field,
                          [&] { all.boxShape.redefine(def); });
        }
    }
}

TEST(BadInput, EveryFieldOfAMaterialIsChecked)
{
    TRACES("R4", "R3", "DC-C_R", "DD12");
    Everything all;
    for (const auto& entry : kMaterialFields) {
        for (const double value : entry.values) {
            ShapeDef def;
            entry.put(def.material, value);
            expectRefused(all, "createShape, " + caseName(entry, value), entry.field,
                          [&] { all.box.createShape(def); });
            expectRefused(all, "redefine, " + caseName(entry, value), entry.field,
                          [&] { all.boxShape.redefine(def); });
            expectRefused(all, "setMaterial, " + caseName(entry, value), entry.field,
                          [&] { all.boxShape.setMaterial(def.material); });
        }
    }
}

TEST(BadInput, ADegeneratePolygonIsExplained)
{
    TRACES("R4", "DC-L");
    const struct {
        const char* name;
        Polygon polygon;
    } cases[] = {
        {"clockwise", rawPolygon({vec(0, 0), vec(0, 1), vec(1, 1), vec(1, 0)})},
        {"on a line", rawPolygon({vec(0, 0), vec(1, 1), vec(2, 2)})},
        {"a thin nothing", rawPolygon({vec(0, 0), vec(1, 0), vec(0.5, 1e-9)})},
        {"all in one point", rawPolygon({vec(1, 1), vec(1, 1), vec(1, 1)})},
        {"the same corner twice", rawPolygon({vec(0, 0), vec(1, 0), vec(1, 0), vec(0, 1)})},
        {"a dent", rawPolygon({vec(0, 0), vec(2, 0), vec(2, 2), vec(1, 0.5), vec(0, 2)})},
        {"a bow tie", rawPolygon({vec(0, 0), vec(1, 1), vec(1, 0), vec(0, 1)})},
        // Turns left at every corner, yet goes around twice: looking at corners alone would take it.
        {"a five-pointed star", rawPolygon({vec(1, 0), vec(-0.809, 0.588), vec(0.309, -0.951),
                                            vec(0.309, 0.951), vec(-0.809, -0.588)})},
        {"too small", rawPolygon({vec(0, 0), vec(1e-8, 0), vec(0, 1e-8)})},
        {"too large", rawPolygon({vec(0, 0), vec(3e6, 0), vec(0, 3e6)})},
    };
    Everything all;
    for (const auto& entry : cases) {
        ShapeDef def;
        def.geometry = entry.polygon;
        expectRefused(all, entry.name, "geometry", [&] { all.box.createShape(def); });
        expectRefused(all, entry.name, "geometry", [&] { all.boxShape.redefine(def); });
    }
}

TEST(BadInput, TheMakersOfPolygonsCheckTheirNumbers)
{
    TRACES("R4", "DC-L");
    for (const double bad : notFiniteAnd({-1, 0})) {
        expectInputError("makeBox", "width", [&] { makeBox(toReal(bad), 1); });
        expectInputError("makeBox", "height", [&] { makeBox(1, toReal(bad)); });
        expectInputError("makeRegularPolygon", "circumradius", [&] { makeRegularPolygon(5, toReal(bad)); });
    }
    for (const double bad : notFiniteAnd({-1, -1e-6})) {
        expectInputError("makeBox", "radius", [&] { makeBox(1, 1, toReal(bad)); });
        expectInputError("makeRegularPolygon", "radius", [&] { makeRegularPolygon(5, 1, toReal(bad)); });
        const std::vector<Vec2> corners = {vec(0, 0), vec(1, 0), vec(0, 1)};
        expectInputError("makePolygon", "radius", [&] { makePolygon(corners, toReal(bad)); });
    }
    for (const int count : {-2147483647, -1, 0, 1, 2, 17, 1000000}) {
        expectInputError("makeRegularPolygon", "count", [&] { makeRegularPolygon(count, 1); });
    }
}

TEST(BadInput, APolygonOfNoAreaOrTooManyCornersIsRefusedWithTheReason)
{
    TRACES("R4", "DC-L");
    std::vector<Vec2> circle;
    for (int i = 0; i < 40; ++i) circle.push_back(vec(std::cos(0.157 * i), std::sin(0.157 * i)));
    const std::vector<std::vector<Vec2>> cases = {
        {},
        {vec(1, 1)},
        {vec(0, 0), vec(1, 0)},
        {vec(0, 0), vec(1, 0), vec(2, 0), vec(5, 0)},
        {vec(3, 3), vec(3, 3), vec(3, 3), vec(3, 3)},
        {vec(0, 0), vec(1, 0), vec(kNaN, 1)},
        {vec(0, 0), vec(1, 0), vec(0, kInfinity)},
        circle,
    };
    for (std::size_t i = 0; i < cases.size(); ++i) {
        expectInputError("makePolygon, case " + std::to_string(i), "points", [&] { makePolygon(cases[i]); });
    }
}

// massProperties and its kin take any Geometry, so also one that no World would take.
TEST(BadInput, TheFreeFunctionsOfGeometryRefuseWhatIsNoShape)
{
    TRACES("R4", "DC-L");
    Polygon tooMany = unitBox(), negative = unitBox(), noNumber = unitBox();
    tooMany.count = 17;
    negative.count = -1;
    noNumber.vertices[1].x = toReal(kNaN);
    const std::vector<Geometry> shapes = {Circle{{}, -1},
                                          Circle{{}, toReal(kNaN)},
                                          Polygon{},
                                          tooMany,
                                          negative,
                                          noNumber,
                                          Capsule{{}, {}, 1},
                                          Segment{{}, {}, 0},
                                          Capsule{{}, vec(kInfinity, 0), 1}};
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const std::string what = "geometry " + std::to_string(i);
        expectInputError(what, "geometry", [&] { area(shapes[i]); });
        expectInputError(what, "geometry", [&] { centroid(shapes[i]); });
        expectInputError(what, "geometry", [&] { massProperties(shapes[i], 1); });
        expectInputError(what, "geometry", [&] { containsPoint(shapes[i], {}); });
    }
    for (const double bad : kNegative) {
        expectInputError("massProperties", "density", [&] { massProperties(Circle{}, toReal(bad)); });
    }
    for (const double bad : kNotFinite) {
        expectInputError("containsPoint", "point", [&] { containsPoint(Circle{}, vec(bad, 0)); });
        const std::vector<Vec2> points = {vec(0, 0), vec(1, bad), vec(0, 1)};
        expectInputError("convexHull", "points", [&] { convexHull(points); });
    }
}

struct ShapeCall {
    const char* name;
    void (*call)(Shape&);
};

const std::vector<ShapeCall> kCallsOfAShape = {
    {"body", [](Shape& s) { s.body(); }},
    {"definition", [](Shape& s) { s.definition(); }},
    {"redefine", [](Shape& s) { s.redefine({}); }},
    {"material", [](Shape& s) { s.material(); }},
    {"setMaterial", [](Shape& s) { s.setMaterial({}); }},
    {"filter", [](Shape& s) { s.filter(); }},
    {"setFilter", [](Shape& s) { s.setFilter({}); }},
    {"density", [](Shape& s) { s.density(); }},
    {"setDensity", [](Shape& s) { s.setDensity(1); }},
    {"userData", [](Shape& s) { s.userData(); }},
    {"setUserData", [](Shape& s) { s.setUserData(1); }},
    {"bounds", [](Shape& s) { s.bounds(); }},
    {"contains", [](Shape& s) { s.contains({}); }},
    {"destroy", [](Shape& s) { s.destroy(); }},
};

TEST(BadInput, ADeadOrNullShapeRefusesEveryCall)
{
    TRACES("R4");
    Everything all;
    Body reborn = addDisc(all.world, {6, 6}, 0.5);  // takes the dead slots
    Shape destroyed = reborn.createShape({});
    destroyed.destroy();
    Shape null;
    EXPECT_FALSE(all.deadShape.isAlive());
    EXPECT_FALSE(null.isAlive());
    EXPECT_TRUE(null.id().isNull());
    for (const ShapeCall& entry : kCallsOfAShape) {
        const std::string name = entry.name;
        expectRefused(all, "shape of a dead body, " + name, "shape", [&] { entry.call(all.deadShape); });
        expectRefused(all, "destroyed shape, " + name, "shape", [&] { entry.call(destroyed); });
        expectRefused(all, "null shape, " + name, "shape", [&] { entry.call(null); });
    }
}

// Each number is good by itself, yet their product is none that a mass can have: what it divides would be no
// number, or what divides by it.
TEST(BadInput, DensitiesThatMakeNoMassAreRefused)
{
    TRACES("R4", "DD1", "DD14");
    Everything all;
    const ShapeDef great{.geometry = makeBox(1e5, 1e5), .density = toReal(1e20)};
    const ShapeDef tiny{.geometry = Circle{{}, toReal(1e-5)}, .density = toReal(1e-30)};
    const ShapeDef slow{.geometry = makeBox(1e6, 1e6), .density = toReal(1e16)};  // 1e28 kg, 1.7e39 kg*m^2
    for (const ShapeDef& def : {great, slow}) {
        expectRefused(all, "createShape", "ShapeDef.density", [&] { all.box.createShape(def); });
        expectRefused(all, "redefine", "ShapeDef.density", [&] { all.boxShape.redefine(def); });
    }
    expectRefused(all, "redefine", "ShapeDef.density", [&] { all.boxShape.redefine(tiny); });
    all.box.createShape(tiny);  // beside the box it does no harm
    all.boxShape.redefine({.geometry = makeBox(10, 10)});
    expectRefused(all, "setDensity", "density", [&] { all.boxShape.setDensity(toReal(1e29)); });

    // A body whose mass is set by hand, or never counts, may have them until it is to count.
    all.disc.setMass({1, {}, 1});
    all.disc.createShape(great);
    expectRefused(all, "resetMass", "mass", [&] { all.disc.resetMass(); });
    all.platform.createShape(great);
    expectRefused(all, "setType", "type", [&] { all.platform.setType(BodyType::Dynamic); });
    EXPECT_EQ(all.world.step().nonFinite, 0u);
}

TEST(BadInput, EveryCallOfAShapeChecksItsNumbers)
{
    TRACES("R4");
    Everything all;
    for (const double bad : kNegative) {
        expectRefused(all, "setDensity", "density", [&] { all.boxShape.setDensity(toReal(bad)); });
    }
    for (const double bad : kNotFinite) {
        expectRefused(all, "contains", "point", [&] { all.boxShape.contains({bad, 0}); });
        expectRefused(all, "contains", "point", [&] { all.boxShape.contains({0, bad}); });
    }
}

}  // namespace
}  // namespace tamias2d
