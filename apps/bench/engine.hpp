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
    explicit Engine(const Scene& scene) : scene_(scene), present_(scene.bodies.size()) {}
    virtual ~Engine() = default;

    /// Bodies that the scene has not at its start come, and go again; joints with the later of their bodies.
    void add(std::size_t body)
    {
        make(body);
        present_[body] = true;
    }
    void remove(std::size_t body)
    {
        present_[body] = false;
        unmake(body);
    }
    bool has(std::size_t body) const { return present_[body]; }

    virtual void step() = 0;  ///< of 1/60 s
    virtual State state(std::size_t body) const = 0;
    virtual void setVelocity(std::size_t body, Vec velocity, double spin) = 0;
    virtual Counts counts() const = 0;
    virtual std::map<std::string, double> phases() const { return {}; }  ///< of the last step   [ms]
    /// Bytes that its tables hold, by name; empty: it does not say.
    virtual std::map<std::string, std::size_t> memory() const { return {}; }
    /// Writes a profile of all steps from now on to `out`, until the engine is destroyed; false: it has none.
    virtual bool profileTo(std::ostream&) { return false; }

protected:
    /// For the constructor: all that is there at the start.
    void addAll()
    {
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i)
            if (scene_.bodies[i].atStart) add(i);
    }
    virtual void make(std::size_t body) = 0;
    virtual void unmake(std::size_t body) = 0;

    const Scene& scene_;  // outlives the engine

private:
    std::vector<bool> present_;
};

struct Options {
    int threads = 1;
};

/// Name, version and settings.
std::string engineTitle();
std::unique_ptr<Engine> makeEngine(const Scene& scene, const Options& options);

inline constexpr double kTimeStep = 1.0 / 60;  ///< [s]

}  // namespace tamias2d::bench
