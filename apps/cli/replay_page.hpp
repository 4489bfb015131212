// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace tamias2d::cli {

/// replay/replay.html as it was when this was built.
std::string_view replayPage() noexcept;

}  // namespace tamias2d::cli
