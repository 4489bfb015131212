// SPDX-License-Identifier: MIT
#include "experiments.hpp"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>

// tamias_verify [-o FILE.json] [GROUP ...]: runs the experiments with every engine and writes the rows.
// tools/verify.py makes docs/verification.md of them. Exit 0 done, 1 the file cannot be written, 2 bad usage.
namespace tamias2d::verify {
namespace {

struct Group {
    const char* key;
    void (*run)(Report&);
};
constexpr Group kGroups[] = {
    {"motion", freeMotion}, {"forces", placeForces},  {"bounces", bounces},       {"impacts", impacts},
    {"gases", gases},       {"sliding", sliding},     {"tunnelling", tunnelling}, {"stacks", stacks},
    {"fine", fineSteps},    {"shared", sharedScenes}, {"timing", timing},
};

int usage()
{
    std::fprintf(stderr, "usage: tamias_verify [-o FILE.json] [GROUP ...]\ngroups:");
    for (const Group& group : kGroups) std::fprintf(stderr, " %s", group.key);
    std::fprintf(stderr, "\n");
    return 2;
}

int verifyMain(int count, char** arguments)
{
    std::string file = "verify.json";
    std::vector<const Group*> chosen;
    for (int i = 1; i < count; ++i) {
        if (std::strcmp(arguments[i], "-o") == 0) {
            if (++i == count) return usage();
            file = arguments[i];
            continue;
        }
        const Group* found = nullptr;
        for (const Group& group : kGroups)
            if (std::strcmp(arguments[i], group.key) == 0) found = &group;
        if (!found) return usage();
        chosen.push_back(found);
    }
    if (chosen.empty())
        for (const Group& group : kGroups) chosen.push_back(&group);

    Report report;
    for (const EngineKind& kind : engines())
        report.json()["engines"].push_back({{"key", kind.key},
                                            {"title", kind.title},
                                            {"settings", kind.settings},
                                            {"precision", kind.precision}});
    for (const Group* group : chosen) {
        std::fprintf(stderr, "%s\n", group->key);
        group->run(report);
    }
    std::ofstream out(file);
    out << report.json().dump(1) << '\n';
    out.close();
    if (!out) {
        std::fprintf(stderr, "tamias_verify: cannot write %s\n", file.c_str());
        return 1;
    }
    return 0;
}

}  // namespace
}  // namespace tamias2d::verify

int main(int count, char** arguments)
{
    return tamias2d::verify::verifyMain(count, arguments);
}
