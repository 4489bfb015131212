// SPDX-License-Identifier: MIT
#pragma once

namespace tamias2d::test {

/// How often this program has allocated memory so far: counting.cpp replaces the operators new and delete.
long allocationCount() noexcept;

}  // namespace tamias2d::test
