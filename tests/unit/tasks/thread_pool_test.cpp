// SPDX-License-Identifier: MIT
#include "tasks/thread_pool.hpp"

#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <set>

namespace tamias2d {
namespace {

// Counts how often each part was done, and by whom.
class Counting final : public Task {
public:
    explicit Counting(int parts) : done(static_cast<std::size_t>(parts)) {}
    void run(int part) noexcept override
    {
        done[static_cast<std::size_t>(part)].fetch_add(1);
        const std::lock_guard<std::mutex> lock(mutex_);
        threads.insert(std::this_thread::get_id());
    }
    bool eachOnce() const
    {
        return std::all_of(done.begin(), done.end(), [](const auto& count) { return count.load() == 1; });
    }
    std::vector<std::atomic<int>> done;
    std::set<std::thread::id> threads;

private:
    std::mutex mutex_;
};

TEST(ThreadPool, DoesEachPartOnceWithItsOwnThreadsOnly)
{
    TRACES("ADR26");
    for (const int threads : {1, 2, 4, 16}) {
        ThreadPool pool(threads);
        EXPECT_EQ(pool.threads(), threads);
        std::set<std::thread::id> all;
        for (int k = 0; k < 500; ++k) {
            Counting task(k % 40);
            pool.run(task, k % 40);
            ASSERT_TRUE(task.eachOnce()) << threads << " threads, run " << k;
            all.insert(task.threads.begin(), task.threads.end());
        }
        EXPECT_LE(all.size(), static_cast<std::size_t>(threads));
    }
}

TEST(ThreadPool, GoesOnAfterItsThreadsHaveFallenAsleep)
{
    TRACES("ADR26");
    ThreadPool pool(3);
    for (int k = 0; k < 20; ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        Counting task(9);
        pool.run(task, 9);
        ASSERT_TRUE(task.eachOnce()) << "run " << k;
    }
}

TEST(ThreadPool, WaitsForASlowPart)
{
    TRACES("ADR26");
    class Slow final : public Task {
    public:
        void run(int part) noexcept override
        {
            if (part == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
            done.fetch_add(1);
        }
        std::atomic<int> done{0};
    } task;
    ThreadPool pool(4);
    pool.run(task, 8);
    EXPECT_EQ(task.done.load(), 8);
}

TEST(ThreadPool, StopsAtOnceBusyOrNot)
{
    TRACES("ADR26");
    for (int k = 0; k < 50; ++k) {
        ThreadPool pool(5);
        if (k % 2 == 0) continue;
        Counting task(3);
        pool.run(task, 3);
    }
}

}  // namespace
}  // namespace tamias2d
