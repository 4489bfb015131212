// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <cstdio>

namespace tamias2d::verify {
namespace {

nlohmann::json orNull(std::optional<double> value)
{
    return value ? nlohmann::json(*value) : nlohmann::json();
}

nlohmann::json toJson(const State& s)
{
    return {s.position.x, s.position.y, s.angle, s.velocity.x, s.velocity.y, s.spin};
}

nlohmann::json toJson(const SceneBody& body)
{
    nlohmann::json corners = nlohmann::json::array();
    for (Vec c : body.corners) corners.push_back({c.x, c.y});
    return {{"fixed", body.fixed},   {"mass", body.mass},  {"inertia", body.inertia},
            {"radius", body.radius}, {"corners", corners}, {"start", toJson(body.start)}};
}

}  // namespace

void Report::group(const std::string& title, const std::string& text)
{
    json_["groups"].push_back({{"title", title}, {"text", text}, {"rows", nlohmann::json::array()}});
}

void Report::measure(const std::string& experiment, const std::vector<Quantity>& quantities,
                     const std::function<Values(const EngineKind&)>& run)
{
    nlohmann::json& rows = json_["groups"].back()["rows"];
    const std::size_t first = rows.size();
    for (const Quantity& q : quantities)
        rows.push_back({{"experiment", experiment},
                        {"quantity", q.name},
                        {"unit", q.unit},
                        {"reference", orNull(q.reference)},
                        {"scale", orNull(q.scale)},
                        {"values", nlohmann::json::object()}});
    for (const EngineKind& kind : engines()) {
        std::fprintf(stderr, "  %-44.44s %s\n", experiment.c_str(), kind.title);
        const Values values = run(kind);
        for (std::size_t i = 0; i < quantities.size(); ++i)
            rows[first + i]["values"][kind.key] = i < values.size() ? orNull(values[i]) : nlohmann::json();
    }
}

void Report::shareScene(const std::string& title, const EngineKind& chipmunk, const Scene& scene)
{
    nlohmann::json bodies = nlohmann::json::array(), samples = nlohmann::json::array();
    for (const SceneBody& body : scene.bodies) bodies.push_back(toJson(body));
    Trial trial(chipmunk, scene);
    for (double seconds : {1.0, 10.0, 60.0}) {
        trial.run(seconds - trial.time());
        nlohmann::json states = nlohmann::json::array();
        for (const State& s : trial.states()) states.push_back(toJson(s));
        samples.push_back({{"time", seconds}, {"states", states}});
    }
    json_["shared"].push_back({{"title", title},
                               {"gravity", {scene.gravity.x, scene.gravity.y}},
                               {"friction", scene.friction},
                               {"restitution", scene.restitution},
                               {"rate", scene.rate},
                               {"bodies", bodies},
                               {"chipmunk", samples}});
}

}  // namespace tamias2d::verify
