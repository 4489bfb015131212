// SPDX-License-Identifier: MIT
// The types of the library into JSON values: the twin of read_values.hpp.
#pragma once

#include "scene/fields.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <type_traits>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

using OrderedJson = nlohmann::ordered_json;

/// The double whose shortest text, read as the given number's type, gives the same number: 0.6f is
/// written 0.6, not 0.60000002384185791.
double shortest(float value);
inline double shortest(double value) noexcept
{
    return value;
}

inline OrderedJson toJson(bool value)
{
    return value;
}
inline OrderedJson toJson(const std::string& value)
{
    return value;
}
template <std::integral T>
OrderedJson toJson(T value)
{
    return value;
}

template <std::floating_point T>
OrderedJson toJson(T value)
{
    // Whole numbers without ".0", but for -0, which only a fraction can say.
    const double number = shortest(value);
    constexpr double kExact = 9007199254740992.0;  // 2^53
    const bool isWhole = std::fabs(number) < kExact && number == std::floor(number);
    if (isWhole && !(number == 0 && std::signbit(number))) return static_cast<std::int64_t>(number);
    return number;
}

template <class T>
    requires std::is_enum_v<T>
OrderedJson toJson(T value)
{
    for (const auto& [name, named] : namesOf(value)) {
        if (named == value) return name;
    }
    return nullptr;
}

inline OrderedJson toJson(Vec2 v)
{
    return OrderedJson::array({toJson(v.x), toJson(v.y)});
}
inline OrderedJson toJson(Position p)
{
    return OrderedJson::array({toJson(p.x), toJson(p.y)});
}

template <HasFields T>
OrderedJson toJson(const T& value);

template <class T>
OrderedJson toJson(const std::optional<T>& value)
{
    return value ? toJson(*value) : OrderedJson(nullptr);
}

/// The members of a struct; those equal to their defaults only if `everything` is wanted. A struct
/// inside it is written whole.
template <HasFields T>
OrderedJson fieldsJson(const T& value, bool everything)
{
    OrderedJson out = OrderedJson::object();
    const T defaults{};
    fieldsOf(&value, [&](const char* key, auto member) {
        const OrderedJson written = toJson(value.*member);
        // Compared as text, since -0 equals 0 as a number and yet must be kept.
        if (everything || written.dump() != toJson(defaults.*member).dump()) out[key] = written;
    });
    return out;
}

template <HasFields T>
OrderedJson toJson(const T& value)
{
    return fieldsJson(value, true);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
