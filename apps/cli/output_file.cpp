// SPDX-License-Identifier: MIT
#include "output_file.hpp"

#include "runner.hpp"

#include <cerrno>
#include <cstring>

namespace tamias2d::cli {

OutputFile::OutputFile(const std::string& path) : path_(path)
{
    if (path_.empty()) return;
    errno = 0;
    stream_.open(path_, std::ios::binary | std::ios::trunc);
    if (!stream_) throw UsageError(path_ + ": cannot be written: " + std::strerror(errno));
}

std::string OutputFile::close()
{
    if (path_.empty()) return {};
    errno = 0;
    stream_.close();
    return stream_ ? std::string() : path_ + ": writing failed: " + std::strerror(errno);
}

}  // namespace tamias2d::cli
