// SPDX-License-Identifier: MIT
#include "scene/geometry_text.hpp"

#include <tamias2d/geometry/hull.hpp>

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

/// Runs a maker of the library; what it refuses is told at the node.
template <class Make>
Geometry made(const Node& node, Make make)
{
    try {
        return make();
    } catch (const SceneError&) {
        throw;
    } catch (const InputError& error) {
        node.refuse(error);
    }
}

Geometry readBox(const Node& node)
{
    real width = 1, height = 1, radius = 0;
    ObjectReader in(node);
    in.read("width", width);
    in.read("height", height);
    in.read("radius", radius);
    in.finish();
    return made(node, [&] { return makeBox(width, height, radius); });
}

Geometry readRegularPolygon(const Node& node)
{
    int count = 6;
    real circumradius = real(0.5), radius = 0;
    ObjectReader in(node);
    in.read("count", count);
    in.read("circumradius", circumradius);
    in.read("radius", radius);
    in.finish();
    return made(node, [&] { return makeRegularPolygon(count, circumradius, radius); });
}

/// Are the points, in this order, all corners of their own convex hull?
bool isHull(const std::vector<Vec2>& points)
{
    const std::vector<Vec2> hull = convexHull(points);
    if (hull.size() != points.size() || points.size() < 3) return false;
    const auto start = std::find(points.begin(), points.end(), hull.front());
    if (start == points.end()) return false;
    const auto turned = static_cast<std::size_t>(start - points.begin());
    for (std::size_t i = 0; i < hull.size(); ++i) {
        if (!(hull[i] == points[(i + turned) % points.size()])) return false;
    }
    return true;
}

Geometry readPolygon(const Node& node)
{
    std::vector<Vec2> points;
    real radius = 0;
    ObjectReader in(node);
    in.each("vertices", [&](const Node& vertex) { readValue(vertex, points.emplace_back()); });
    in.read("radius", radius);
    in.finish();
    if (!node.has("vertices")) node.refuse("must have the key \"vertices\"");
    if (!isHull(points) || points.size() > kMaxPolygonVertices) {
        return made(node, [&] { return makePolygon(points, radius); });
    }
    // Corners keep their order, as contacts know them by number: what was written reads back the same.
    Polygon polygon;
    std::copy(points.begin(), points.end(), polygon.vertices.begin());
    polygon.count = static_cast<int>(points.size());
    polygon.radius = radius;
    return polygon;
}

template <class T>
Geometry readPlain(const Node& node)
{
    T geometry;
    readValue(node, geometry);
    return geometry;
}

constexpr struct {
    const char* key;
    Geometry (*read)(const Node&);
} kGeometryKinds[] = {
    {"circle", readPlain<Circle>},   {"capsule", readPlain<Capsule>},
    {"segment", readPlain<Segment>}, {"box", readBox},
    {"polygon", readPolygon},        {"regularPolygon", readRegularPolygon},
};

constexpr const char* kOneKind =
    "must have exactly one of circle, capsule, segment, box, polygon, regularPolygon";

bool sameCorners(const Polygon& a, const Polygon& b)
{
    return a.count == b.count && std::equal(a.points().begin(), a.points().end(), b.points().begin());
}

OrderedJson polygonJson(const Polygon& polygon)
{
    OrderedJson out;
    if (polygon.count == 4) {
        const Vec2 corner = polygon.vertices[0];
        const real width = -2 * corner.x, height = -2 * corner.y;
        if (width > 0 && height > 0 && sameCorners(polygon, makeBox(width, height, polygon.radius))) {
            out["box"] = {{"width", toJson(width)}, {"height", toJson(height)}};
            if (polygon.radius != 0) out["box"]["radius"] = toJson(polygon.radius);
            return out;
        }
    }
    OrderedJson vertices = OrderedJson::array();
    for (const Vec2 vertex : polygon.points()) vertices.push_back(toJson(vertex));
    out["polygon"] = {{"vertices", vertices}};
    if (polygon.radius != 0) out["polygon"]["radius"] = toJson(polygon.radius);
    return out;
}

struct GeometryWriter {
    OrderedJson operator()(const Circle& shape) const { return {{"circle", fieldsJson(shape, true)}}; }
    OrderedJson operator()(const Capsule& shape) const { return {{"capsule", fieldsJson(shape, true)}}; }
    OrderedJson operator()(const Segment& shape) const { return {{"segment", fieldsJson(shape, true)}}; }
    OrderedJson operator()(const Polygon& shape) const { return polygonJson(shape); }
};

}  // namespace

Geometry readGeometry(ObjectReader& shape)
{
    std::optional<Geometry> geometry;
    for (const auto& kind : kGeometryKinds) {
        const std::optional<Node> node = shape.find(kind.key);
        if (!node) continue;
        if (geometry) node->refuse(kOneKind);
        geometry = kind.read(*node);
    }
    if (geometry) return *geometry;
    // A misspelt kind should be told as such, and finish() does.
    shape.finish();
    shape.node().refuse(kOneKind);
}

void writeGeometry(OrderedJson& shape, const Geometry& geometry)
{
    const OrderedJson written = std::visit(GeometryWriter{}, geometry);
    for (const auto& item : written.items()) shape[item.key()] = item.value();
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
