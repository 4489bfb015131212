// SPDX-License-Identifier: MIT
// The command `tamias2d`: reads the command line, calls the runner of the wanted precision, prints.
// docs/guide/command-line.md is its manual. Exit codes: 0 done, 1 the run failed, 2 wrong usage or input.
#include "progress.hpp"
#include "report.hpp"
#include "runner.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string>

namespace tamias2d::cli {

namespace {

enum ExitCode { kDone = 0, kFailed = 1, kWrongUsage = 2 };

struct Options {
    RunRequest request;
    std::string precision = "f32";
    bool quiet = false;
};

const Runner& runnerOf(const Options& options)
{
    return options.precision == "f64" ? f64::kRunner : f32::kRunner;
}

/// One line on the error output, whatever the text holds.
int complain(std::string text, ExitCode code)
{
    std::replace(text.begin(), text.end(), '\n', ' ');
    fmt::print(stderr, "tamias2d: {}\n", text);
    return code;
}

template <class T>
void checkOption(const char* flag, const std::optional<T>& value, double least, double most, const char* rule)
{
    if (!value) return;
    const double number = static_cast<double>(*value);
    if (!(number >= least && number <= most))
        throw UsageError(fmt::format("{} = {}: {}", flag, *value, rule));
}

void checkRequest(const RunRequest& request)
{
    checkOption("--seconds", request.seconds, 0, 1e9, "must be in [0, 1e9] s");
    checkOption("--steps", request.steps, 0, 1e15, "must be in [0, 1e15]");
    checkOption("--rate", request.rate, 1, 1e6, "must be in [1, 1e6] Hz");
    checkOption("--substeps", request.substeps, 1, 256, "must be in [1, 256]");
}

int run(Options options)
{
    checkRequest(options.request);
    RunResult result;
    double seconds = 0;
    {
        Progress progress;
        if (!options.quiet) {
            options.request.onStep = [&](std::int64_t done, std::int64_t total) {
                progress.show(done, total);
            };
        }
        result = runnerOf(options).run(options.request);
        seconds = progress.seconds();
    }
    if (!options.quiet) {
        const std::string& title = result.title.empty() ? options.request.scene : result.title;
        fmt::print("{}: {} bodies\n{}", title, result.bodies.size(), tableText(result, seconds));
        for (const std::string* file : {&options.request.trace, &options.request.report,
                                        &options.request.replay, &options.request.profile}) {
            if (!file->empty()) fmt::print("  wrote      {}\n", *file);
        }
    }
    if (!result.failure.empty()) return complain("the run failed: " + result.failure, kFailed);
    return kDone;
}

int check(const Options& options)
{
    const SceneSummary s = runnerOf(options).check(options.request.scene);
    fmt::print("{}: good. {} bodies, {} shapes, {} force laws; {:g} s at {:g} Hz x {}\n",
               options.request.scene, s.bodies, s.shapes, s.laws, s.seconds, s.rate, s.substeps);
    return kDone;
}

int hash(const Options& options)
{
    checkRequest(options.request);
    fmt::print("{}\n", hashText(runnerOf(options).hash(options.request)));
    return kDone;
}

int listScenes()
{
    fmt::print("Built-in scenes; set parameters like this: tamias2d run pyramid:base=20\n");
    for (const BuiltinText& scene : f32::kRunner.builtins()) {
        fmt::print("\n{:<10} {}\n", scene.name, scene.doc);
        for (const BuiltinText::Parameter& p : scene.parameters) {
            fmt::print("  {:<22} {} ({})\n", p.name + "=" + p.standard, p.doc, p.range);
        }
    }
    return kDone;
}

void addSceneOption(CLI::App* verb, Options& options)
{
    verb->add_option("SCENE", options.request.scene, "a scene file, or a built-in scene (pyramid:base=20)")
        ->required();
    verb->add_option("--precision", options.precision, "f32 (default) or f64")
        ->check(CLI::IsMember({"f32", "f64"}));
}

void addStepOptions(CLI::App* verb, Options& options)
{
    verb->add_option("--rate", options.request.rate, "steps per second [Hz]; default: the scene's");
    verb->add_option("--substeps", options.request.substeps, "sub-steps of each step; default: the scene's");
    verb->add_option("--threads", options.request.threads,
                     "that work together, 1 to 64; no result depends on it")
        ->check(CLI::Range(1, 64));
}

void addRunOptions(CLI::App* verb, Options& options)
{
    RunRequest& request = options.request;
    auto* seconds = verb->add_option("--seconds", request.seconds, "how long [s]; default: the scene's");
    verb->add_option("--steps", request.steps, "how long, in steps")->excludes(seconds);
    addStepOptions(verb, options);
    verb->add_option("--trace", request.trace, "write every state to this CSV file");
    verb->add_option("--report", request.report, "write the result to this JSON file");
    verb->add_option("--replay", request.replay, "write a page to this HTML file, to watch in a browser");
    verb->add_option("--profile", request.profile,
                     "write how long each stage took to this JSON file, for a trace viewer");
    verb->add_flag("--quiet", options.quiet, "print nothing but errors");
}

/// CLI11 has a code and a text of many lines for each mistake; ours are one code and one line.
int parse(CLI::App& app, int argc, char** argv)
{
    try {
        app.parse(argc, argv);
        return -1;
    } catch (const CLI::Success& wish) {
        return app.exit(wish);
    } catch (const CLI::ParseError& error) {
        return complain(std::string(error.what()) + " (see tamias2d --help)", kWrongUsage);
    }
}

int start(int argc, char** argv)
{
    Options options;
    CLI::App app("Simulates 2D rigid bodies: right, fast, friendly.", "tamias2d");
    app.set_version_flag("--version", "tamias2d " TAMIAS_CLI_VERSION);
    app.require_subcommand(1);
    app.footer("Exit codes: 0 done, 1 the run failed, 2 wrong usage or input.");

    CLI::App* runVerb = app.add_subcommand("run", "Simulate a scene");
    addSceneOption(runVerb, options);
    addRunOptions(runVerb, options);
    CLI::App* checkVerb =
        app.add_subcommand("check", "Read a scene and say what is wrong with it, if anything");
    addSceneOption(checkVerb, options);
    CLI::App* hashVerb = app.add_subcommand("hash", "Print the hash of the state after some steps");
    addSceneOption(hashVerb, options);
    hashVerb->add_option("--steps", options.request.steps, "how many steps")->required();
    addStepOptions(hashVerb, options);
    app.add_subcommand("scenes", "List the built-in scenes and their parameters");

    if (const int code = parse(app, argc, argv); code >= 0) return code;
    if (*runVerb) return run(options);
    if (*checkVerb) return check(options);
    if (*hashVerb) return hash(options);
    return listScenes();
}

}  // namespace

}  // namespace tamias2d::cli

int main(int argc, char** argv)
{
    using namespace tamias2d::cli;
    try {
        return start(argc, argv);
    } catch (const UsageError& error) {
        return complain(error.what(), kWrongUsage);
    } catch (const std::exception& error) {
        return complain(std::string("the run failed: ") + error.what(), kFailed);
    }
}
