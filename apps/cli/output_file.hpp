// SPDX-License-Identifier: MIT
#pragma once

#include <fstream>
#include <string>

namespace tamias2d::cli {

/// A file to write, or none if its name is empty.
class OutputFile {
public:
    /// @throws UsageError if the file cannot be opened for writing
    explicit OutputFile(const std::string& path);

    explicit operator bool() const noexcept { return !path_.empty(); }
    std::ostream& stream() noexcept { return stream_; }

    /// Writes what is left. Returns why that failed, or nothing.
    std::string close();

private:
    std::string path_;
    std::ofstream stream_;
};

}  // namespace tamias2d::cli
