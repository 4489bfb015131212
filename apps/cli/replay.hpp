// SPDX-License-Identifier: MIT
#pragma once

#include "output_file.hpp"

#include <tamias2d/scene/scene.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace tamias2d::cli::TAMIAS_PRECISION {

struct ReplayTiming {
    std::int64_t steps;
    double rate;  ///< [Hz]
    int substeps;
};

/// The page of --replay: the template replay/replay.html with one JSON object in its place,
///
///     {"title", "precision", "rate", "substeps", "version", "dt", "view": {"lower", "upper"},
///      "bodies": [{"name", "type", "shapes": [{"kind", "points", "radius"}]}],
///      "joints": [{"line": [[body or -1, x, y], ...], "dots": [likewise], "dashed"}],
///      "frames": [{"t", "poses": [x, y, angle, ...], "velocities": [vx, vy, w, ...],
///                  "contacts": [[x, y, nx, ny, impulse], ...], "hits": [likewise, of the steps since the
///                  last frame], "energy": [kinetic, potential, total], "momentum": [px, py, L]}],
///      "breaks": [[joint, t], ...]}
///
/// A recording has at most kMostFrames, and fewer if its bodies are many: then steps are left out
/// evenly. The last state is always there.
class Replay {
public:
    Replay(const Scene& scene, const ReplayTiming& timing);

    /// Notes what the last step did.
    void add(const World& world);
    void write(OutputFile& file, const World& world);

private:
    struct Frame {
        std::string state;  ///< all of the frame but its hits, as JSON
        std::string hits;   ///< without the brackets
    };

    void noteHits(const World& world);
    void addFrame(const World& world);
    void thinOut();

    std::string head_;  ///< the object up to the frames
    ReplayTiming timing_;
    std::vector<BodyId> bodies_;
    std::vector<JointId> joints_;
    std::vector<BodyState> states_;
    std::vector<Frame> frames_;
    std::string hits_;          ///< since the last frame
    std::string breaks_;        ///< of joints, without the brackets
    std::int64_t stride_ = 1;   ///< steps from frame to frame
    std::int64_t step_ = 0;
    std::int64_t framedStep_ = 0;
    std::size_t bytes_ = 0;     ///< of all frames
    int decimals_ = 5;          ///< of lengths
};

}  // namespace tamias2d::cli::TAMIAS_PRECISION
