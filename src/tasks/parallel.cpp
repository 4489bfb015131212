// SPDX-License-Identifier: MIT
#include "tasks/parallel.hpp"

#include "tasks/thread_pool.hpp"

#include <tamias2d/math/scalar.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// More parts than threads, so that one that is held up does not hold up all.
constexpr int kPartsPerThread = 4;

const void* thisThread()
{
    thread_local const char here = 0;
    return &here;
}

}  // namespace

Parallel::Parallel(int threads, TaskSystem* host, Profile& profile) : profile_(profile)
{
    known_.reserve(kMaxThreads);
    use(threads, host);
}

Parallel::~Parallel() = default;

void Parallel::use(int threads, TaskSystem* host)
{
    system_ = host;
    pool_.reset();
    known_.clear();
#if TAMIAS_HAS_THREADS
    if (system_ == nullptr && threads > 1) {
        pool_ = std::make_unique<ThreadPool>(threads);
        system_ = pool_.get();
    }
#else
    static_cast<void>(threads);
#endif
    threads_ = system_ == nullptr ? 1 : clamp(system_->threads(), 1, kMaxThreads);
}

void Parallel::share(const Job& job)
{
    job_ = job;
    parts_ = static_cast<int>(
        minimum(job.chunks, static_cast<std::size_t>(minimum(kPartsPerThread * threads_, kMaxParts))));
    unfinished_.store(parts_, std::memory_order_relaxed);
    for (int i = 0; i < parts_; ++i) open_[static_cast<std::size_t>(i)].store(1, std::memory_order_release);

#if TAMIAS_HAS_EXCEPTIONS
    try {
        system_->run(*this, parts_);
    } catch (...) {  // NOLINT(bugprone-empty-catch): the host's affair; ours is that all gets done
    }
#else
    system_->run(*this, parts_);
#endif
    // What a host has not done, or not finished.
    if (unfinished_.load(std::memory_order_acquire) > 0) {
        for (int i = 0; i < parts_; ++i) run(i);
        while (unfinished_.load(std::memory_order_acquire) > 0) {
#if TAMIAS_HAS_THREADS
            std::this_thread::yield();
#endif
        }
    }
    if (profile_.isOn()) noteTurns();
}

void Parallel::run(int part) noexcept
{
    if (part < 0 || part >= kMaxParts) return;
    const auto at = static_cast<std::size_t>(part);
    if (open_[at].exchange(0, std::memory_order_acq_rel) == 0) return;
    if (profile_.isOn()) {
        turns_[at].thread = thisThread();
        turns_[at].begin = profile_.now();
    }
    doPart(at);
    if (profile_.isOn()) turns_[at].end = profile_.now();
    unfinished_.fetch_sub(1, std::memory_order_acq_rel);
}

void Parallel::doPart(std::size_t part)
{
    const Job& job = job_;
    const auto parts = static_cast<std::size_t>(parts_);
    const std::size_t begin = job.chunks * part / parts, end = job.chunks * (part + 1) / parts;
    for (std::size_t k = begin; k < end; ++k) job.call(job.body, chunkOf(k, job.count, job.grain));
}

// One span a thread, from the first of its turns to the last. That of the caller is the stage's own.
void Parallel::noteTurns()
{
    const void* const caller = thisThread();
    for (int i = 0; i < parts_; ++i) {
        const Turn& first = turns_[static_cast<std::size_t>(i)];
        if (first.thread == nullptr || first.thread == caller) continue;
        double begin = first.begin, end = first.end;
        for (int k = i + 1; k < parts_; ++k) {
            Turn& turn = turns_[static_cast<std::size_t>(k)];
            if (turn.thread != first.thread) continue;
            begin = minimum(begin, turn.begin);
            end = maximum(end, turn.end);
            turn.thread = nullptr;
        }
        profile_.add(numberOf(first.thread), begin, end);
    }
}

std::uint32_t Parallel::numberOf(const void* thread)
{
    for (std::size_t i = 0; i < known_.size(); ++i)
        if (known_[i] == thread) return static_cast<std::uint32_t>(i + 1);
    if (known_.size() == kMaxThreads) return kMaxThreads;  // a host that keeps changing its threads
    known_.push_back(thread);
    return static_cast<std::uint32_t>(known_.size());
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
