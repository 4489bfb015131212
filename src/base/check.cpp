// SPDX-License-Identifier: MIT
#include "base/check.hpp"

#include <array>
#include <charconv>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

template <class T>
std::string shortest(T value)
{
    std::array<char, 32> text{};  // the longest double needs 24
    const auto [end, status] = std::to_chars(text.data(), text.data() + text.size(), value);
    return status == std::errc{} ? std::string(text.data(), end) : std::string("?");
}

// The sign and payload of a NaN differ between platforms; a message does not.
template <class T>
std::string shortestOrNan(T value)
{
    return std::isnan(value) ? std::string("nan") : shortest(value);
}

}  // namespace

std::string textOf(double value)
{
    return shortestOrNan(value);
}
std::string textOf(float value)
{
    return shortestOrNan(value);
}
std::string textOf(long long value)
{
    return shortest(value);
}
std::string textOf(unsigned long long value)
{
    return shortest(value);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
