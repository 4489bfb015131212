// SPDX-License-Identifier: MIT
// JSON values into the types of the library. Only kinds are checked here (a number, a pair, a known
// word); what range a value must lie in is the library's to say, so that there is one rule.
#pragma once

#include "scene/fields.hpp"
#include "scene/nearest.hpp"
#include "scene/node.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

template <class T>
concept IsPair = requires(T t) {
    { t.x } -> std::convertible_to<double>;
    { t.y } -> std::convertible_to<double>;
} && !HasFields<T>;

inline void readValue(const Node& node, bool& out)
{
    if (!node.value().is_boolean()) node.refuse("must be true or false");
    out = node.value().get<bool>();
}

inline void readValue(const Node& node, std::string& out)
{
    if (!node.value().is_string()) node.refuse("must be text in quotes");
    out = node.value().get<std::string>();
}

template <std::floating_point T>
void readValue(const Node& node, T& out)
{
    if (!node.value().is_number()) node.refuse("must be a number");
    const double value = node.value().get<double>();
    // A double out of range of a float has no float to become.
    if (std::fabs(value) > static_cast<double>(std::numeric_limits<T>::max())) {
        node.refuse("must be finite in single precision, that is within 3.4e38 of zero");
    }
    out = static_cast<T>(value);
}

template <std::integral T>
void readValue(const Node& node, T& out)
{
    const std::string rule = "must be a whole number from " + std::to_string(std::numeric_limits<T>::min()) +
                             " to " + std::to_string(std::numeric_limits<T>::max());
    const Json& value = node.value();
    if (!value.is_number_integer()) node.refuse(rule);
    const bool fits = value.is_number_unsigned() ? std::in_range<T>(value.get<std::uint64_t>())
                                                 : std::in_range<T>(value.get<std::int64_t>());
    if (!fits) node.refuse(rule);
    out = value.get<T>();
}

template <IsPair T>
void readValue(const Node& node, T& out)
{
    if (!node.value().is_array() || node.value().size() != 2) node.refuse("must be two numbers: [x, y]");
    readValue(node.child(std::size_t{0}), out.x);
    readValue(node.child(std::size_t{1}), out.y);
}

template <class T>
    requires std::is_enum_v<T>
void readValue(const Node& node, T& out)
{
    std::vector<std::string> known;
    for (const auto& [name, value] : namesOf(T{})) {
        if (node.value() == name) {
            out = value;
            return;
        }
        known.emplace_back(name);
    }
    const std::string word = node.value().is_string() ? node.value().get<std::string>() : std::string();
    node.refuse("unknown word" + suggestion(word, known));
}

template <class T>
void readValue(const Node& node, std::optional<T>& out);
template <HasFields T>
void readValue(const Node& node, T& out);

/// Reads the keys of one object, and knows in the end which nobody asked for.
class ObjectReader {
public:
    explicit ObjectReader(const Node& node) : node_(node)
    {
        if (!node.value().is_object()) node.refuse("must be an object: { ... }");
    }

    const Node& node() const noexcept { return node_; }

    /// Notes the key as one that may be there; empty if it is not.
    std::optional<Node> find(const std::string& key)
    {
        known_.push_back(key);
        if (!node_.has(key)) return std::nullopt;
        return node_.child(key);
    }

    /// Reads the key into `out`, which keeps its value if the key is not there.
    template <class T>
    bool read(const std::string& key, T& out)
    {
        const std::optional<Node> child = find(key);
        if (child) readValue(*child, out);
        return child.has_value();
    }

    template <class T>
    void require(const std::string& key, T& out)
    {
        if (!read(key, out)) node_.refuse("must have the key \"" + key + "\"");
    }

    template <HasFields T>
    void readFields(T& out)
    {
        fieldsOf(static_cast<const T*>(nullptr),
                 [&](const char* key, auto member) { read(key, out.*member); });
    }

    /// Calls `visit` for each element of a list.
    template <class Visit>
    void each(const std::string& key, Visit visit)
    {
        const std::optional<Node> list = find(key);
        if (!list) return;
        if (!list->value().is_array()) list->refuse("must be a list: [ ... ]");
        for (std::size_t i = 0; i < list->value().size(); ++i) visit(list->child(i));
    }

    /// Refuses keys that nobody asked for. "$comment" is for the author and allowed anywhere.
    void finish() const
    {
        for (const auto& item : node_.value().items()) {
            const std::string& key = item.key();
            if (key == "$comment") continue;
            if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
                node_.child(key).refuse("unknown key" + suggestion(key, known_));
            }
        }
    }

private:
    Node node_;
    std::vector<std::string> known_;
};

/// null says "none", as leaving the key out does.
template <class T>
void readValue(const Node& node, std::optional<T>& out)
{
    if (node.value().is_null()) {
        out.reset();
        return;
    }
    T value{};
    readValue(node, value);
    out = value;
}

template <HasFields T>
void readValue(const Node& node, T& out)
{
    ObjectReader reader(node);
    reader.readFields(out);
    reader.finish();
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
