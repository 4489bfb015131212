// SPDX-License-Identifier: MIT
#pragma once

#include "output_file.hpp"

#include <tamias2d/world/world.hpp>

#include <string>
#include <vector>

namespace tamias2d::cli::TAMIAS_PRECISION {

/// The file of --trace: CSV, one row for each body that can move and one for all of them together
/// ("*"), for the start and after each step.
class Trace {
public:
    Trace(OutputFile& file, World& world);

    void add(World& world);

private:
    std::ostream* out_;
    std::vector<BodyId> bodies_;
    std::vector<std::string> names_;  ///< ready for a CSV cell
};

}  // namespace tamias2d::cli::TAMIAS_PRECISION
