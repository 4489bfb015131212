// SPDX-License-Identifier: MIT
#include "tasks/thread_pool.hpp"

#if TAMIAS_HAS_THREADS

#include <cstdint>
#include <system_error>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Some 20 to 50 us. Threads that share a processor do not look: they would keep each other waiting.
int looksOf(int threads)
{
    constexpr int kLooks = 1500;
    return static_cast<unsigned>(threads) <= std::thread::hardware_concurrency() ? kLooks : 0;
}

}  // namespace

void Gate::breathe()
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
}

void Gate::notify(int threads)
{
    const int asleep = sleepers_.load();
    if (asleep == 0) return;
    {
        const std::lock_guard<std::mutex> lock(mutex_);
    }  // nobody is between looking and sleeping now
    if (threads >= asleep) {
        wake_.notify_all();
    } else {
        for (int i = 0; i < threads; ++i) wake_.notify_one();
    }
}

ThreadPool::ThreadPool(int threads)
    : shareCount_(static_cast<std::size_t>(threads)), shares_(std::make_unique<Share[]>(shareCount_)),
      begun_(looksOf(threads)), finished_(looksOf(threads))
{
    workers_.reserve(static_cast<std::size_t>(threads - 1));
    const auto start = [&] {
        while (static_cast<int>(workers_.size()) + 1 < threads)
            workers_.emplace_back([this, thread = workers_.size() + 1] { work(thread); });
    };
#if TAMIAS_HAS_EXCEPTIONS
    try {  // with fewer, if no more are to be had: the results are the same
        start();
    } catch (const std::system_error&) {  // NOLINT(bugprone-empty-catch)
    }
#else
    start();
#endif
}

ThreadPool::~ThreadPool()
{
    stop_.store(true);
    begun_.notify(threads());
    for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::run(Task& task, int parts)
{
    if (parts <= 0) return;
    task_ = &task;
    unfinished_.store(parts);
    const int count = threads();
    for (int i = 0, begin = 0; i < count; ++i) {
        Share& share = shares_[static_cast<std::size_t>(i)];
        share.end = static_cast<int>(static_cast<std::int64_t>(parts) * (i + 1) / count);
        share.untaken.store(share.end - begin);  // from here on others take
        begin = share.end;
    }
    begun_.notify(parts - 1);
    doParts(0);
    finished_.await([this] { return unfinished_.load() == 0; });
}

bool ThreadPool::hasUntaken() const
{
    for (std::size_t i = 0; i < shareCount_; ++i)
        if (shares_[i].untaken.load() > 0) return true;
    return false;
}

void ThreadPool::work(std::size_t thread)
{
    for (;;) {
        begun_.await([this] { return stop_.load() || hasUntaken(); });
        if (stop_.load()) return;
        doParts(thread);
    }
}

// A thread that comes late may find the parts of a later run, and takes one of those as well.
bool ThreadPool::takePart(std::size_t of, int& part)
{
    Share& share = shares_[of];
    int left = share.untaken.load();
    do {
        if (left <= 0) return false;
    } while (!share.untaken.compare_exchange_weak(left, left - 1));
    part = share.end - left;
    return true;
}

void ThreadPool::doParts(std::size_t thread)
{
    for (std::size_t i = 0; i < shareCount_; ++i) {
        const std::size_t share = thread + i < shareCount_ ? thread + i : thread + i - shareCount_;
        int part = 0;
        while (takePart(share, part)) {
            task_->run(part);
            if (unfinished_.fetch_sub(1) == 1) finished_.notify(1);
        }
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION

#endif
