// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

namespace tamias2d::test {

/// Records which requirements and decisions a test proves; tools/check_trace.py joins them.
inline void recordTraces(std::initializer_list<const char*> ids)
{
    std::string all;
    for (const char* id : ids) {
        if (!all.empty()) all += ',';
        all += id;
    }
    testing::Test::RecordProperty("traces", all);
}

}  // namespace tamias2d::test

/// First line of a test case: TRACES("R5", "IM1");
#define TRACES(...) ::tamias2d::test::recordTraces({__VA_ARGS__})
