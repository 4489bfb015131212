// SPDX-License-Identifier: MIT
#include "support/traces.hpp"

#include <tamias2d/scene/read.hpp>

#include <gtest/gtest.h>

#include <filesystem>

namespace tamias2d::test {
namespace {

TEST(SceneFiles, EveryOneCanBeReadAndRunForASecond)
{
    TRACES("R1", "R2", "ADR14");
    int count = 0;
    for (const auto& file : std::filesystem::directory_iterator(TAMIAS_SOURCE_DIR "/scenes")) {
        if (file.path().extension() != ".json") continue;
        const Scene scene = loadSceneFile(file.path().string());
        EXPECT_FALSE(scene.info.title.empty()) << file.path();
        EXPECT_FALSE(scene.info.description.empty()) << file.path();
        const int steps = static_cast<int>(scene.info.rate);
        for (int i = 0; i < steps; ++i) {
            const StepReport report = scene.world->step(1 / scene.info.rate, scene.info.substeps);
            ASSERT_EQ(report.status, StepStatus::Done) << file.path();
            ASSERT_EQ(report.nonFinite, 0u) << file.path();
        }
        ++count;
    }
    EXPECT_GE(count, 10);
}

}  // namespace
}  // namespace tamias2d::test
