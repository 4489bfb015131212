// SPDX-License-Identifier: MIT
#include "tasks/parallel.hpp"

#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace tamias2d {
namespace {

// A host that does with a task what the test says.
class Host final : public TaskSystem {
public:
    using Does = std::function<void(Task&, int)>;
    explicit Host(Does does, int threads = 4) : does_(std::move(does)), threads_(threads) {}
    int threads() const noexcept override { return threads_; }
    void run(Task& task, int parts) override
    {
        ++runs;
        does_(task, parts);
    }
    int runs = 0;

private:
    Does does_;
    int threads_;
};

// How often each place was visited.
std::vector<int> visits(Parallel& parallel, std::size_t count, std::size_t grain)
{
    std::vector<int> visited(count, 0);
    parallel.forEach(count, grain, [&](const Chunk& chunk) {
        for (std::size_t i = chunk.begin; i < chunk.end; ++i) ++visited[i];
    });
    return visited;
}

TEST(Parallel, VisitsEachPlaceOnceWithAnyNumberOfThreads)
{
    TRACES("ADR6", "ADR26");
    for (const int threads : {1, 2, 3, 8, 64}) {
        Profile profile;
        Parallel parallel(threads, nullptr, profile);
        for (const std::size_t count : {0u, 1u, 7u, 64u, 1000u})
            for (const std::size_t grain : {1u, 10u, 64u, 5000u})
                EXPECT_EQ(visits(parallel, count, grain), std::vector<int>(count, 1))
                    << threads << " threads, " << count << " by " << grain;
    }
}

TEST(Parallel, CutsARangeAlikeWithAnyNumberOfThreads)
{
    TRACES("ADR6", "ADR26");
    std::map<int, std::vector<std::pair<std::size_t, std::size_t>>> cuts;
    for (const int threads : {1, 2, 7}) {
        Profile profile;
        Parallel parallel(threads, nullptr, profile);
        cuts[threads].resize(Parallel::chunksOf(103, 10));
        parallel.forEach(103, 10,
                         [&](const Chunk& chunk) { cuts[threads][chunk.index] = {chunk.begin, chunk.end}; });
    }
    EXPECT_EQ(cuts[1].size(), 11u);
    EXPECT_EQ(cuts[1].back(), std::make_pair(std::size_t{100}, std::size_t{103}));
    EXPECT_EQ(cuts[2], cuts[1]);
    EXPECT_EQ(cuts[7], cuts[1]);
}

TEST(Parallel, EndsALoopBeforeTheNextBegins)
{
    TRACES("ADR26");
    Profile profile;
    Parallel parallel(4, nullptr, profile);
    std::vector<long> values(200, 1);
    constexpr int kLoops = 3000;
    for (int k = 0; k < kLoops; ++k) {
        const std::vector<long> before = values;
        parallel.forEach(values.size(), 10, [&](const Chunk& chunk) {
            for (std::size_t i = chunk.begin; i < chunk.end; ++i)
                values[i] = before[values.size() - 1 - i] % 1000 + 1;
        });
    }
    EXPECT_EQ(values, std::vector<long>(200, 1 + kLoops % 1000));
}

TEST(Parallel, AsksAHostForLoopsOfSomeLengthOnly)
{
    TRACES("ADR26");
    Profile profile;
    Host host([](Task& task, int parts) {
        for (int i = 0; i < parts; ++i) task.run(i);
    });
    Parallel parallel(1, &host, profile);
    EXPECT_EQ(parallel.threads(), 4);
    visits(parallel, 10 * (Parallel::kLeastChunks - 1), 10);
    EXPECT_EQ(host.runs, 0);
    visits(parallel, 10 * Parallel::kLeastChunks, 10);
    EXPECT_EQ(host.runs, 1);
}

TEST(Parallel, TakesTheNearerEndForAHostWithTooFewOrTooManyThreads)
{
    TRACES("R4", "ADR26");
    Profile profile;
    Host none([](Task&, int) {}, -5), many([](Task&, int) {}, 1000);
    EXPECT_EQ(Parallel(1, &none, profile).threads(), 1);
    EXPECT_EQ(Parallel(1, &many, profile).threads(), kMaxThreads);
}

struct BadHost {
    const char* name;
    Host::Does does;
};

TEST(Parallel, DoesWhatABadHostLeavesUndoneAndNothingTwice)
{
    TRACES("R4", "ADR26");
    const BadHost hosts[] = {
        {"does nothing", [](Task&, int) {}},
        {"does some",
         [](Task& task, int parts) {
             for (int i = 0; i < parts; i += 2) task.run(i);
         }},
        {"does all twice",
         [](Task& task, int parts) {
             for (int i = 0; i < 2 * parts; ++i) task.run(i % parts);
         }},
        {"does parts that are not there",
         [](Task& task, int parts) {
             for (const int i : {-1, parts, parts + 1, 255, 256, 1 << 30, -(1 << 30)}) task.run(i);
         }},
        {"throws in the middle",
         [](Task& task, int) {
             task.run(0);
             throw std::runtime_error("the host has had enough");
         }},
    };
    for (const BadHost& bad : hosts) {
        Profile profile;
        Host host(bad.does);
        Parallel parallel(1, &host, profile);
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(visits(parallel, 1000, 10), std::vector<int>(1000, 1)) << "a host that " << bad.name;
    }
}

TEST(Parallel, WaitsForAHostThatReturnsTooEarlyAndLaughsAtLateCalls)
{
    TRACES("R4", "ADR26");
    Profile profile;
    std::vector<std::thread> threads;
    Host host([&](Task& task, int parts) {
        threads.emplace_back([&task, parts] {
            for (int k = 0; k < 50; ++k)
                for (int i = parts - 1; i >= 0; --i) task.run(i);
        });
    });
    Parallel parallel(1, &host, profile);
    for (int k = 0; k < 20; ++k)
        EXPECT_EQ(visits(parallel, 5000, 10), std::vector<int>(5000, 1)) << "in loop " << k;
    for (std::thread& thread : threads) thread.join();
}

TEST(Parallel, KeepsASpanForEachOtherThreadOfALoopUnderTheNameOfItsStage)
{
    TRACES("NFR1", "ADR26");
    Profile profile;
    profile.setOn(true);
    Host host([](Task& task, int parts) {  // half of it here, half on another thread
        std::thread other([&] {
            for (int i = 0; i < parts / 2; ++i) task.run(i);
        });
        for (int i = parts / 2; i < parts; ++i) task.run(i);
        other.join();
    });
    Parallel parallel(1, &host, profile);
    {
        const ProfileScope whole(profile, "whole");
        ProfileScope stage(profile, "first stage");
        visits(parallel, 100, 10);
        stage.next("second stage");
        visits(parallel, 100, 10);
    }
    std::vector<std::string> others;
    double end = 0;
    for (const ProfileSpan& span : profile.spans()) {
        if (span.thread == 0) continue;
        others.push_back(span.name);
        EXPECT_EQ(span.depth, 0u);
        EXPECT_GE(span.begin, end);
        EXPECT_GE(span.end, span.begin);
        end = span.end;
    }
    EXPECT_EQ(others, (std::vector<std::string>{"first stage", "second stage"}));
}

TEST(Parallel, MayChangeItsThreadsBetweenLoops)
{
    TRACES("ADR26");
    Profile profile;
    Parallel parallel(1, nullptr, profile);
    for (const int threads : {2, 1, 5, 3, 1}) {
        parallel.use(threads, nullptr);
        EXPECT_EQ(parallel.threads(), threads);
        EXPECT_EQ(visits(parallel, 100, 3), std::vector<int>(100, 1));
    }
}

}  // namespace
}  // namespace tamias2d
