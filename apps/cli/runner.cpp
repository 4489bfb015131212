// SPDX-License-Identifier: MIT
// Simulates a scene and measures it. Compiled twice, in float and in double.
#include "runner.hpp"

#include "profile/profile_json.hpp"
#include "replay.hpp"
#include "report.hpp"
#include "trace.hpp"

#include <tamias2d/scene/builtin.hpp>
#include <tamias2d/scene/read.hpp>
#include <tamias2d/tamias2d.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace tamias2d::cli::TAMIAS_PRECISION {

namespace {

constexpr bool kIsDouble = std::numeric_limits<real>::digits > 24;

Scene open(const std::string& name)
{
    try {
        return openScene(name);
    } catch (const InputError& error) {
        throw UsageError(error.what());
    }
}

struct Timing {
    std::int64_t steps = 0;
    double rate = 60;
    int substeps = 4;
    double dt() const { return 1 / rate; }
};

/// What the command line says, else what the scene says. Both were checked by their readers.
Timing timingOf(const RunRequest& request, const SceneInfo& info)
{
    Timing timing;
    timing.rate = request.rate.value_or(info.rate);
    timing.substeps = request.substeps.value_or(info.substeps);
    const double seconds = request.seconds.value_or(info.seconds);
    timing.steps = request.steps.value_or(std::llround(seconds * timing.rate));
    return timing;
}

MomentumResult momentumOf(const World& world)
{
    const Momentum momentum = world.momentum();
    return {{momentum.linear.x, momentum.linear.y}, momentum.angular};
}

std::vector<BodyResult> bodiesOf(World& world)
{
    std::vector<BodyResult> results;
    for (const BodyId id : world.bodies()) {
        const Body body = world.body(id);
        const Position p = body.position();
        const DVec2 v = toDVec2(body.linearVelocity());
        results.push_back(
            {body.name(), {p.x, p.y}, body.angle(), {v.x, v.y}, static_cast<double>(body.angularVelocity())});
    }
    return results;
}

std::uint64_t sumOf(const ClampCounts& c)
{
    return std::uint64_t{c.speed} + c.position + c.push + c.impactsPerContact + c.advancement;
}

/// Why a step makes the run a failure; empty if it does not.
std::string failureOf(const StepReport& report)
{
    if (report.status != StepStatus::Done) return "the step was refused";
    if (report.nonFinite > 0) {
        return fmt::format("{} {} set aside because a value became no number", report.nonFinite,
                           report.nonFinite == 1 ? "body was" : "bodies were");
    }
    if (report.forceLawFaults > 0) return "a force law gave no number";
    return {};
}

/// One step, with its wall-clock time in milliseconds.
double timedStep(World& world, const Timing& timing)
{
    const auto before = std::chrono::steady_clock::now();
    world.step(timing.dt(), timing.substeps);
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - before;
    return taken.count();
}

void measureStep(const World& world, double milliseconds, RunResult& result)
{
    const StepReport& report = world.lastReport();
    ++result.steps;
    result.meanStep += milliseconds;  // the sum, until finish()
    result.maxStep = std::max(result.maxStep, milliseconds);
    result.energyHighest = std::max(result.energyHighest, world.energy().total());
    result.deepestPenetration = std::max(result.deepestPenetration, report.deepestOverlap);
    result.limitsHit += sumOf(report.clamps);
    const std::string failure = failureOf(report);
    if (!failure.empty()) result.failure = fmt::format("{} in step {}", failure, result.steps);
}

void finish(World& world, RunResult& result)
{
    if (result.steps > 0) {
        result.meanStep /= static_cast<double>(result.steps);
        result.contacts = world.lastReport().touching;
    }
    result.time = world.time();
    result.bodies = bodiesOf(world);
    result.energyAfter = world.energy().total();
    result.momentumAfter = momentumOf(world);
    result.hash = world.stateHash();
}

RunResult run(const RunRequest& request)
{
    const Scene scene = open(request.scene);
    World& world = *scene.world;
    const Timing timing = timingOf(request, scene.info);
    scene.world->setThreads(request.threads);

    // Files first: a path that cannot be written should not cost a run.
    OutputFile traceFile(request.trace), reportFile(request.report), replayFile(request.replay),
        profileFile(request.profile);
    std::optional<Trace> trace;
    std::optional<Replay> replay;
    std::optional<apps::ProfileJson> profile;
    if (traceFile) trace.emplace(traceFile, world);
    if (profileFile) profile.emplace(profileFile.stream());
    world.setProfiling(profile.has_value());
    if (replayFile) replay.emplace(scene, ReplayTiming{timing.steps, timing.rate, timing.substeps});

    RunResult result;
    result.title = scene.info.title;
    result.precision = kIsDouble ? "f64" : "f32";
    result.rate = timing.rate;
    result.substeps = timing.substeps;
    result.energyBefore = result.energyHighest = world.energy().total();
    result.momentumBefore = momentumOf(world);

    while (result.steps < timing.steps && result.failure.empty()) {
        measureStep(world, timedStep(world, timing), result);
        if (profile) profile->add(world.profile(), result.steps);
        if (trace) trace->add(world);
        if (replay) replay->add(world);
        if (request.onStep) request.onStep(result.steps, timing.steps);
    }

    finish(world, result);
    if (profile) profile->finish();
    if (replay) replay->write(replayFile, world);
    if (reportFile) reportFile.stream() << reportText(result);
    for (OutputFile* file : {&traceFile, &reportFile, &replayFile, &profileFile}) {
        const std::string failure = file->close();
        if (!failure.empty() && result.failure.empty()) result.failure = failure;
    }
    return result;
}

SceneSummary check(const std::string& name)
{
    const Scene scene = open(name);
    return {scene.info.title,          scene.world->bodyCount(),
            scene.world->shapeCount(), scene.world->forceLaws().size(),
            scene.info.seconds,        scene.info.rate,
            scene.info.substeps};
}

std::uint64_t hash(const RunRequest& request)
{
    const Scene scene = open(request.scene);
    const Timing timing = timingOf(request, scene.info);
    scene.world->setThreads(request.threads);
    for (std::int64_t i = 0; i < timing.steps; ++i) scene.world->step(timing.dt(), timing.substeps);
    return scene.world->stateHash();
}

std::string rangeOf(const BuiltinParameter& p)
{
    switch (p.type) {
    case BuiltinParameterType::Switch:
        return "true or false";
    case BuiltinParameterType::Choice:
        return fmt::format("{}", fmt::join(p.choices, ", "));
    case BuiltinParameterType::Integer:
        return fmt::format("whole, {} to {}", p.least, p.most);
    case BuiltinParameterType::Number:
        break;
    }
    return fmt::format("{} to {}", p.least, p.most);
}

std::vector<BuiltinText> builtins()
{
    std::vector<BuiltinText> texts;
    for (const BuiltinScene& scene : builtinScenes()) {
        BuiltinText text{scene.name, scene.doc, {}};
        for (const BuiltinParameter& p : scene.parameters) {
            text.parameters.push_back({p.name, p.standard, rangeOf(p), p.doc});
        }
        texts.push_back(std::move(text));
    }
    return texts;
}

}  // namespace

const Runner kRunner = {run, check, hash, builtins};

}  // namespace tamias2d::cli::TAMIAS_PRECISION
