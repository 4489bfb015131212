// SPDX-License-Identifier: MIT
#pragma once

#include "base/check.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Collects what is wrong with the rows of a table, each as a line like
/// "bodies[3].velocity = (nan, 0): must be finite". Text is made for faults only.
class Faults {
public:
    /// What follows is about this row.
    void at(std::string_view table, std::size_t row)
    {
        table_ = table;
        row_ = row;
    }

    template <class T>
    void that(bool holds, std::string_view field, const T& value, std::string_view rule)
    {
        if (holds) return;
        found_.push_back(std::string(table_) + "[" + textOf(row_) + "]." + std::string(field) + " = " +
                         textOf(value) + ": " + std::string(rule));
    }
    template <class T>
    void finite(std::string_view field, const T& value)
    {
        that(isFiniteValue(value), field, value, "must be finite");
    }
    /// Is low <= value <= high? NaN is in no range.
    template <class T>
    void range(std::string_view field, T value, double low, double high, std::string_view rule)
    {
        const double v = static_cast<double>(value);
        that(v >= low && v <= high, field, value, rule);
    }
    /// Is its length 1, but for some rounding errors of a turn?
    template <class Vector>
    void unit(std::string_view field, const Vector& value)
    {
        constexpr double kError = 1e-4;
        range(field, static_cast<double>(length(value)), 1 - kError, 1 + kError, "must have length 1");
    }

    const std::vector<std::string>& found() const { return found_; }

private:
    std::string_view table_;
    std::size_t row_ = 0;
    std::vector<std::string> found_;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
