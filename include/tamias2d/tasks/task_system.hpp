// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

inline constexpr int kMaxThreads = 64;  ///< that work for one World

/// A piece of work in parts: some stage of a step, made by the World.
class Task {
public:
    /// Does a part, on any thread, while other threads do others. A part that has been done is not done
    /// again.
    virtual void run(int part) noexcept = 0;

protected:
    ~Task() = default;
};

/// Who does the parts of a step: the interface for a host that has threads of its own, as games do. Without
/// one, a World with several threads starts and keeps them itself.
///
/// No result depends on it: neither on how many threads there are, nor on who does which part and when.
/// It must outlive the Worlds it works for, and may work for several of them at once.
class TaskSystem {
public:
    virtual ~TaskSystem() = default;

    /// How many threads may do parts at one time, the calling one included. Asked once by each World; what is
    /// not in 1 to 64 is taken for the nearer end. With 1 the World never calls run().
    virtual int threads() const noexcept = 0;

    /// Calls task.run(i) for each i in [0, parts), in any order and on any threads, the calling one if it
    /// likes, and returns when all of these calls have returned. Called some hundred times a step, from the
    /// thread that calls World::step, so it should cost microseconds.
    ///
    /// The World itself does what is left undone, also if this throws. What is not allowed is to call the
    /// task when its World is no more.
    virtual void run(Task& task, int parts) = 0;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
