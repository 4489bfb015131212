// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <ostream>
#include <string>

namespace tamias2d::bench {

/// What an engine says of its last step, as far as it does.
struct Counts {
    long awake = -1;     ///< bodies; -1: it does not say
    long contacts = -1;  ///< touching
    std::uint64_t hash = 0;
};

/// One engine with one scene loaded: the door all of them are driven through. Each program of the suite is
/// linked with one engine.
class Engine {
public:
    virtual ~Engine() = default;
    virtual void step() = 0;  ///< of 1/60 s
    virtual State state(std::size_t body) const = 0;
    virtual void setVelocity(std::size_t body, Vec velocity, double spin) = 0;
    virtual Counts counts() const = 0;
    virtual std::map<std::string, double> phases() const { return {}; }  ///< of the last step   [ms]
    /// Bytes that its tables hold, by name; empty: it does not say.
    virtual std::map<std::string, std::size_t> memory() const { return {}; }
    /// Writes a profile of all steps from now on to `out`, until the engine is destroyed; false: it has none.
    virtual bool profileTo(std::ostream&) { return false; }
};

struct Options {
    int threads = 1;
};

/// Name, version and settings.
std::string engineTitle();
std::unique_ptr<Engine> makeEngine(const Scene& scene, const Options& options);

inline constexpr double kTimeStep = 1.0 / 60;  ///< [s]

}  // namespace tamias2d::bench
