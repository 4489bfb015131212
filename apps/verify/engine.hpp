// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <memory>
#include <span>
#include <string>

namespace tamias2d::verify {

/// One engine with one scene loaded: the door all of them are driven through.
class Engine {
public:
    virtual ~Engine() = default;
    /// One step of 1 / Scene::rate.
    virtual void step() = 0;
    virtual State state(std::size_t body) const = 0;
};

/// An engine under test, with its default settings.
struct EngineKind {
    const char* key;       ///< in the JSON
    const char* title;     ///< in the report
    const char* settings;  ///< of a step
    const char* precision; ///< that it calculates in
    bool ours;             ///< else a peer
    bool rounds;           ///< has polygons with rounded corners
    std::unique_ptr<Engine> (*make)(const Scene&);
    /// The gap at which two shapes of this engine rest on each other [m]. Scenes that start at
    /// rest are laid out with it, so that no engine begins with a fall or an overlap.
    double (*restGap)(const SceneBody& a, const SceneBody& b);
};

std::span<const EngineKind> engines();

std::unique_ptr<Engine> makeTamiasF32(const Scene& scene);
std::unique_ptr<Engine> makeTamiasF64(const Scene& scene);
std::unique_ptr<Engine> makeChipmunk(const Scene& scene);
std::unique_ptr<Engine> makeBox2D(const Scene& scene);

/// What the scene's laws pull on each body with, for engines that hold a force over a step.
std::vector<Pull> pullsOn(const Scene& scene, const std::vector<State>& states, double t);

/// An engine at work on a scene, with the scene at hand.
class Trial {
public:
    Trial(const EngineKind& kind, Scene scene);
    Trial(const Trial&) = delete;  ///< the engine looks at this scene

    void step();
    void run(double seconds);
    double time() const { return steps_ / scene_.rate; }
    State state(std::size_t body) const { return engine_->state(body); }
    std::vector<State> states() const;
    const Scene& scene() const { return scene_; }

private:
    Scene scene_;
    std::unique_ptr<Engine> engine_;
    double steps_ = 0;
};

}  // namespace tamias2d::verify
