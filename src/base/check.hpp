// SPDX-License-Identifier: MIT
// Looks at inputs and says what is wrong with them [R4]. A check costs a comparison; text is made
// for a refused value only. Typical use, which raises the first of several complaints:
//
//     if (Checks()
//             .finite("BodyDef.position", def.position)
//             .range("BodyDef.linearDamping", def.linearDamping, 0, kAnyFinite, "must be >= 0 1/s")
//             .refuse())
//         return {};
#pragma once

#include <tamias2d/base/error.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The upper end of a range that refuses infinity only.
inline constexpr double kAnyFinite = std::numeric_limits<double>::max();

/// Vec2, DVec2 and Position, which live in a higher layer.
template <class T>
concept HasXy = requires(const T& v) {
    { v.x } -> std::convertible_to<double>;
    { v.y } -> std::convertible_to<double>;
};

/// The shortest text that reads back as the same number: "1.1", "-1", "nan", "inf".
std::string textOf(double value);
std::string textOf(float value);
std::string textOf(long long value);
std::string textOf(unsigned long long value);

template <std::integral T>
std::string textOf(T value)
{
    if constexpr (std::signed_integral<T>)
        return textOf(static_cast<long long>(value));
    else
        return textOf(static_cast<unsigned long long>(value));
}

/// "(nan, 2)"
template <HasXy T>
std::string textOf(const T& v)
{
    return "(" + textOf(v.x) + ", " + textOf(v.y) + ")";
}

/// Quoted, so that an empty text shows.
inline std::string textOf(std::string_view text)
{
    return '"' + std::string(text) + '"';
}
inline std::string textOf(const char* text)
{
    return textOf(std::string_view(text));
}

inline bool isFiniteValue(double value) noexcept
{
    return std::isfinite(value);
}
template <HasXy T>
bool isFiniteValue(const T& v) noexcept
{
    return std::isfinite(v.x) && std::isfinite(v.y);
}

using Complaint = std::optional<InputError>;  ///< empty: nothing wrong

template <class T>
Complaint checkThat(bool holds, std::string_view field, const T& value, std::string_view rule)
{
    if (holds) return std::nullopt;
    return InputError(std::string(field), textOf(value), std::string(rule));
}

template <class T>
Complaint checkFinite(std::string_view field, const T& value, std::string_view rule = "must be finite")
{
    return checkThat(isFiniteValue(value), field, value, rule);
}

/// Is low <= value <= high? NaN is in no range.
template <class T>
    requires std::floating_point<T> || std::integral<T>
Complaint checkRange(std::string_view field, T value, double low, double high, std::string_view rule)
{
    const double v = static_cast<double>(value);
    return checkThat(v >= low && v <= high, field, value, rule);
}

/// The first complaint of several checks.
class Checks {
public:
    template <class T>
    Checks& that(bool holds, std::string_view field, const T& value, std::string_view rule)
    {
        return add(first_ ? std::nullopt : checkThat(holds, field, value, rule));
    }
    template <class T>
    Checks& finite(std::string_view field, const T& value, std::string_view rule = "must be finite")
    {
        return add(first_ ? std::nullopt : checkFinite(field, value, rule));
    }
    template <class T>
    Checks& range(std::string_view field, T value, double low, double high, std::string_view rule)
    {
        return add(first_ ? std::nullopt : checkRange(field, value, low, high, rule));
    }
    Checks& add(Complaint complaint)
    {
        if (!first_ && complaint) first_ = std::move(complaint);
        return *this;
    }

    const Complaint& first() const noexcept { return first_; }

    /// Raises the first complaint. In a build without exceptions it returns true after telling the
    /// error handler, and the caller returns without having changed anything; false: all is well.
    bool refuse() const
    {
        if (!first_) return false;
        fail(*first_);
        return true;
    }

private:
    Complaint first_;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
