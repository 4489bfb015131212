// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

// Motions known from outside the library: closed forms, and an integrator of its own for those
// that have none.
namespace tamias2d::test {

/// The state after `time` [s] of y' = rate(t, y), by the classical fourth-order method with `steps` steps.
/// With some ten thousand steps it is right to rounding for every motion in these tests.
template <std::size_t N, class Rate>
std::array<double, N> integrated(std::array<double, N> y, double time, int steps, Rate&& rate)
{
    using State = std::array<double, N>;
    const double h = time / steps;
    const auto plus = [](State a, double s, const State& b) {
        for (std::size_t i = 0; i < N; ++i) a[i] += s * b[i];
        return a;
    };
    for (int i = 0; i < steps; ++i) {
        const double t = i * h;
        const State k1 = rate(t, y);
        const State k2 = rate(t + h / 2, plus(y, h / 2, k1));
        const State k3 = rate(t + h / 2, plus(y, h / 2, k2));
        const State k4 = rate(t + h, plus(y, h, k3));
        for (std::size_t k = 0; k < N; ++k) y[k] += h / 6 * (k1[k] + 2 * k2[k] + 2 * k3[k] + k4[k]);
    }
    return y;
}

/// How fast an error falls: log2 of the error at a step over that at half the step. 2 is second order.
inline double orderOf(double coarse, double fine)
{
    return std::log2(coarse / fine);
}

}  // namespace tamias2d::test
