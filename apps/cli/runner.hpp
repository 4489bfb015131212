// SPDX-License-Identifier: MIT
// What the command line asks of the engine. This header knows no precision: runner.cpp is compiled
// once for each, and the two meet here [ADR2].
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tamias2d::cli {

/// Wrong usage or input: exit code 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What to simulate and how. What is not given is the scene's to say.
struct RunRequest {
    std::string scene;  ///< a path, or the name of a built-in scene with its parameters
    std::optional<double> seconds;
    std::optional<std::int64_t> steps;
    std::optional<double> rate;  ///< [Hz]
    std::optional<int> substeps;
    int threads = 1;
    std::string trace, report, replay, profile;  ///< files to write; empty: none
    /// Called after each step with the steps done and all there are to do.
    std::function<void(std::int64_t, std::int64_t)> onStep;
};

struct BodyResult {
    std::string name;
    std::array<double, 2> position;  ///< of the origin             [m]
    double angle;                    ///< in [0, 2 pi)              [rad]
    std::array<double, 2> velocity;  ///< of the center of mass     [m/s]
    double angularVelocity;          ///< [rad/s]
};

struct MomentumResult {
    std::array<double, 2> linear;  ///< [kg*m/s]
    double angular;                ///< about the world's origin   [kg*m^2/s]
};

struct RunResult {
    std::string title;
    std::string failure;  ///< why the run stopped early; empty: it did not
    std::int64_t steps = 0;
    double time = 0;  ///< of the world's clock at the end   [s]
    std::string precision;
    double rate = 0;
    int substeps = 0;
    std::vector<BodyResult> bodies;
    double energyBefore = 0, energyAfter = 0, energyHighest = 0;  ///< [J]
    MomentumResult momentumBefore = {}, momentumAfter = {};
    std::uint32_t contacts = 0;       ///< that touch at the end
    double deepestPenetration = 0;    ///< of any step's end   [m]
    double meanStep = 0, maxStep = 0; ///< wall-clock time of one step   [ms]
    std::uint64_t limitsHit = 0;      ///< sum of all clamps of all steps
    std::uint64_t hash = 0;           ///< of the state at the end
};

struct SceneSummary {
    std::string title;
    std::size_t bodies = 0, shapes = 0, laws = 0;
    double seconds = 0, rate = 0;
    int substeps = 0;
};

/// A built-in scene, ready to be printed.
struct BuiltinText {
    struct Parameter {
        std::string name, standard, range, doc;
    };
    std::string name, doc;
    std::vector<Parameter> parameters;
};

/// The engine in one precision.
struct Runner {
    RunResult (*run)(const RunRequest& request);           ///< @throws UsageError
    SceneSummary (*check)(const std::string& scene);       ///< @throws UsageError
    std::uint64_t (*hash)(const RunRequest& request);  ///< of the state after the run   @throws UsageError
    std::vector<BuiltinText> (*builtins)();
};

namespace f32 {
extern const Runner kRunner;
}
namespace f64 {
extern const Runner kRunner;
}

}  // namespace tamias2d::cli
