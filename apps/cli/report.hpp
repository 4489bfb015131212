// SPDX-License-Identifier: MIT
#pragma once

#include "runner.hpp"

namespace tamias2d::cli {

/// The file of --report: JSON, with units as in docs/guide/command-line.md.
std::string reportText(const RunResult& result);

/// The table that `run` prints.
std::string tableText(const RunResult& result, double wallSeconds);

/// A state hash as it is shown everywhere: 16 hexadecimal digits.
std::string hashText(std::uint64_t hash);

}  // namespace tamias2d::cli
