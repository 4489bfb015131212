// SPDX-License-Identifier: MIT
// Runs one scene in the one engine this program is linked with, and prints a line of JSON. tools/bench.py
// calls it, for many scenes and engines by turns.

#include "engine.hpp"
#include "quality.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <stdexcept>

namespace tamias2d::bench {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// What there is of a scene now.
struct Size {
    std::size_t free = 0, shapes = 0, joints = 0;
};

Size sizeOf(const Scene& scene, const Engine& engine)
{
    Size size;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (!engine.has(i)) continue;
        size.free += scene.bodies[i].mobility == Mobility::Free ? 1 : 0;
        size.shapes += scene.bodies[i].shapes.size();
        size.joints += jointsOf(scene, i).size();
    }
    return size;
}

nlohmann::json run(const Scene& scene, int steps, const Options& options, const std::string& profile)
{
    const auto start = Clock::now();
    std::ofstream profileFile;  // outlives the engine, which writes its end
    const std::unique_ptr<Engine> engine = makeEngine(scene, options);
    const double build = millisecondsSince(start);
    if (!profile.empty()) {
        profileFile.open(profile);
        if (!profileFile) throw std::runtime_error(profile + " cannot be written");
        if (!engine->profileTo(profileFile)) throw std::runtime_error(engineTitle() + " keeps no profile");
    }

    std::vector<double> times;
    std::map<std::string, double> phases;
    double awake = 0, contacts = 0;
    for (int i = 0; i < steps; ++i) {
        if (scene.drive) scene.drive(*engine, i);
        const auto before = Clock::now();
        engine->step();
        times.push_back(millisecondsSince(before));
        for (const auto& [name, time] : engine->phases()) phases[name] += time / steps;
        if (i % 16 != 0) continue;
        const Counts counts = engine->counts();
        awake += static_cast<double>(counts.awake) * 16 / steps;
        contacts += static_cast<double>(counts.contacts) * 16 / steps;
    }
    double total = 0;
    for (double t : times) total += t;
    std::sort(times.begin(), times.end());

    const Counts last = engine->counts();
    const Quality quality = measureQuality(scene, *engine);
    const Size size = sizeOf(scene, *engine);
    nlohmann::json line = {{"engine", engineTitle()},
                           {"scene", scene.name},
                           {"threads", options.threads},
                           {"steps", steps},
                           {"bodies", size.free},
                           {"shapes", size.shapes},
                           {"joints", size.joints},
                           {"buildMs", build},
                           {"stepMs", total / steps},
                           {"medianMs", times[times.size() / 2]},
                           {"slowestMs", times.back()},
                           {"phasesMs", phases},
                           {"deepest", quality.deepest},
                           {"mean", quality.mean},
                           {"kineticEnergyPerBody", quality.kineticEnergy / static_cast<double>(size.free)},
                           {"fastest", quality.fastest},
                           {"top", quality.top},
                           {"jointError", quality.jointError},
                           {"awakeAtEnd", last.awake},
                           {"contactsAtEnd", last.contacts}};
    if (const auto memory = engine->memory(); !memory.empty()) line["memoryBytes"] = memory;
    if (last.awake >= 0) line["nsPerAwakeBody"] = 1e6 * total / steps / std::max(awake, 1.0);
    if (last.contacts >= 0) line["nsPerContact"] = 1e6 * total / steps / std::max(contacts, 1.0);
    if (last.hash != 0) line["hash"] = fmt::format("{:016x}", last.hash);
    return line;
}

}  // namespace
}  // namespace tamias2d::bench

int main(int argc, char** argv)
{
    using namespace tamias2d::bench;
    CLI::App app{"One scene in one engine: " + engineTitle()};
    std::string name, profile;
    int steps = 0;
    Options options;
    bool list = false;
    app.add_option("scene", name, "its name");
    app.add_option("--steps", steps, "instead of the scene's own number")->check(CLI::PositiveNumber);
    app.add_option("--threads", options.threads, "for engines that have any")->check(CLI::Range(1, 64));
    app.add_option("--profile", profile, "write how long each stage of each step took to this JSON file");
    app.add_flag("--list", list, "names and groups of the scenes, as JSON");
    CLI11_PARSE(app, argc, argv);

    if (list) {
        nlohmann::json all = nlohmann::json::array();
        for (const SceneEntry& entry : scenes())
            all.push_back({{"name", entry.name}, {"group", entry.group}});
        fmt::print("{}\n", all.dump());
        return 0;
    }
    for (const SceneEntry& entry : scenes()) {
        if (entry.name != name) continue;
        const Scene scene = entry.make();
        try {
            fmt::print("{}\n", run(scene, steps > 0 ? steps : scene.steps, options, profile).dump());
        } catch (const std::runtime_error& error) {
            fmt::print(stderr, "{}\n", error.what());
            return 1;
        }
        return 0;
    }
    fmt::print(stderr, "no scene named \"{}\"; --list names them\n", name);
    return 2;
}
