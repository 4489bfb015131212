// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/tasks/task_system.hpp>

#if TAMIAS_HAS_THREADS

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Where threads wait for something to become so. Stages of a step follow each other within microseconds, so
/// a thread looks again for a while before it sleeps.
class Gate {
public:
    explicit Gate(int looks) : looks_(looks) {}

    /// Returns once `isOpen` says true. What it reads must be sequentially consistent, like what opens it.
    template <class IsOpen>
    void await(IsOpen isOpen)
    {
        for (int i = 0; i < looks_; ++i) {
            if (isOpen()) return;
            breathe();
        }
        std::unique_lock<std::mutex> lock(mutex_);
        sleepers_.fetch_add(1);
        wake_.wait(lock, isOpen);
        sleepers_.fetch_sub(1);
    }
    /// After something has become so: up to `threads` of those that sleep look again. Either a thread that is
    /// about to sleep sees the change, or it is seen here.
    void notify(int threads);

private:
    const int looks_;
    std::atomic<int> sleepers_{0};
    std::mutex mutex_;
    std::condition_variable wake_;

    static void breathe();
};

/// The built-in task system: threads that are started once and kept. Neighboring parts are offered to the
/// same thread run after run, as what they work on may still be in the cache of its processor; who is done
/// with his share helps others.
class ThreadPool final : public TaskSystem {
public:
    /// With the calling thread as one of them; fewer if the system gives no more.
    explicit ThreadPool(int threads);
    ~ThreadPool() override;
    ThreadPool(const ThreadPool&) = delete;

    int threads() const noexcept override { return static_cast<int>(workers_.size()) + 1; }
    void run(Task& task, int parts) override;

private:
    // Of a run, by thread.
    struct alignas(64) Share {
        std::atomic<int> untaken{0};  // parts of it that nobody has taken yet
        int end = 0;  // after its last part
    };

    Task* task_ = nullptr;  // whoever has taken a part may read this
    const std::size_t shareCount_;
    std::unique_ptr<Share[]> shares_;
    std::atomic<bool> stop_{false};
    std::atomic<int> unfinished_{0};  // parts
    Gate begun_, finished_;
    std::vector<std::thread> workers_;

    void work(std::size_t thread);
    bool takePart(std::size_t share, int& part);
    void doParts(std::size_t thread);
    bool hasUntaken() const;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION

#endif
