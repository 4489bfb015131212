// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tamias2d::cli {

std::string hashText(std::uint64_t hash)
{
    return fmt::format("{:016x}", hash);
}

std::string reportText(const RunResult& result)
{
    using Json = nlohmann::ordered_json;
    Json bodies = Json::array();
    for (const BodyResult& body : result.bodies) {
        bodies.push_back({{"name", body.name},
                          {"position", body.position},
                          {"angle", body.angle},
                          {"velocity", body.velocity},
                          {"angularVelocity", body.angularVelocity}});
    }
    const MomentumResult& momentum = result.momentumAfter;
    const Json report = {
        {"steps", result.steps},
        {"time", result.time},
        {"precision", result.precision},
        {"bodies", bodies},
        {"energy",
         {{"initial", result.energyBefore},
          {"final", result.energyAfter},
          {"highest", result.energyHighest}}},
        {"momentum", {{"linear", momentum.linear}, {"angular", momentum.angular}}},
        {"contacts", result.contacts},
        {"deepestPenetration", result.deepestPenetration},
        {"msPerStep", {{"mean", result.meanStep}, {"max", result.maxStep}}},
        {"hash", hashText(result.hash)},
    };
    return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string tableText(const RunResult& r, double wallSeconds)
{
    const auto momentum = [](const MomentumResult& m) {
        return fmt::format("({:.4g}, {:.4g}), {:.4g}", m.linear[0], m.linear[1], m.angular);
    };
    std::string out;
    const auto row = [&](const char* label, const std::string& text) {
        out += fmt::format("  {:<10} {}\n", label, text);
    };
    row("steps", fmt::format("{} of 1/{:g} s x {}, {}: {:g} s simulated in {:.2f} s", r.steps, r.rate,
                             r.substeps, r.precision, r.time, wallSeconds));
    row("ms/step", fmt::format("{:.3f} mean, {:.3f} longest", r.meanStep, r.maxStep));
    row("energy", fmt::format("{:.6g} J before, {:.6g} J after, {:.6g} J highest", r.energyBefore,
                              r.energyAfter, r.energyHighest));
    row("momentum", fmt::format("{} before, {} after   [kg*m/s], [kg*m^2/s]", momentum(r.momentumBefore),
                                momentum(r.momentumAfter)));
    row("contacts",
        fmt::format("{} touch at the end; deepest penetration {:.3g} m", r.contacts, r.deepestPenetration));
    if (r.limitsHit > 0)
        row("limits", fmt::format("the solver had to limit something {} times", r.limitsHit));
    row("hash", hashText(r.hash));
    return out;
}

}  // namespace tamias2d::cli
