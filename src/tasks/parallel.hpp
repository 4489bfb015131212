// SPDX-License-Identifier: MIT
#pragma once

#include "base/timer.hpp"

#include <tamias2d/tasks/task_system.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Some neighbors of a range.
struct Chunk {
    std::size_t index;        ///< of the chunk: results are put together in this order
    std::size_t begin, end;   ///< in the range
};

/// Loops whose turns may be side by side. Where a range is cut into chunks depends on the range alone;
/// threads only choose who does which of them. So results that are kept by place or by chunk have the same
/// bits with any number of threads [ADR6, ADR26].
class Parallel final : private Task {
public:
    /// As use(). The spans of other threads go into the profile.
    Parallel(int threads, TaskSystem* host, Profile& profile);
    ~Parallel();
    Parallel(const Parallel&) = delete;

    /// From here on with a host's threads, or, if `host` is null, with that many of its own.
    void use(int threads, TaskSystem* host);

    int threads() const { return threads_; }

    /// Loops of fewer chunks are not worth waking and waiting for others. A chunk is 3 us or more.
    static constexpr std::size_t kLeastChunks = 4;

    static std::size_t chunksOf(std::size_t count, std::size_t grain) { return (count + grain - 1) / grain; }

    /// Calls body(Chunk) for each chunk of [0, count), `grain` of them at a time; the last may be shorter.
    /// A body may write only what belongs to its chunk. With one thread, or few chunks, this is a loop.
    template <class Body>
    void forEach(std::size_t count, std::size_t grain, Body&& body)
    {
        const std::size_t chunks = chunksOf(count, grain);
        if (threads_ == 1 || chunks < kLeastChunks) {
            for (std::size_t k = 0; k < chunks; ++k) body(chunkOf(k, count, grain));
            return;
        }
        auto call = [](const void* with, const Chunk& chunk) {
            (*static_cast<std::remove_reference_t<Body>*>(const_cast<void*>(with)))(chunk);
        };
        share({&body, call, count, grain, chunks});
    }

private:
    static constexpr int kMaxParts = 256;
    struct Job {
        const void* body = nullptr;
        void (*call)(const void*, const Chunk&) = nullptr;
        std::size_t count = 0, grain = 1, chunks = 0;
    };
    struct Turn {  // for the profile
        const void* thread = nullptr;
        double begin = 0, end = 0;
    };

    int threads_ = 1;
    Profile& profile_;
    TaskSystem* system_ = nullptr;
    std::unique_ptr<TaskSystem> pool_;

    // Whoever takes a part may read the job. Parts are taken, not given: so no host can have one done twice,
    // and one that is called for after its job has ended is none.
    Job job_;
    int parts_ = 0;
    std::array<std::atomic<std::uint8_t>, kMaxParts> open_{};
    std::atomic<int> unfinished_{0};
    std::array<Turn, kMaxParts> turns_;
    std::vector<const void*> known_;  // threads in the profile, from number 1 on

    static Chunk chunkOf(std::size_t k, std::size_t count, std::size_t grain)
    {
        const std::size_t begin = k * grain;
        return {k, begin, count - begin < grain ? count : begin + grain};
    }
    void share(const Job& job);
    void run(int part) noexcept override;
    void doPart(std::size_t part);
    void noteTurns();
    std::uint32_t numberOf(const void* thread);
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
