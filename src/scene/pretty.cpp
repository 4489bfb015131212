// SPDX-License-Identifier: MIT
#include "scene/pretty.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

constexpr std::size_t kLineLength = 110;

std::string quoted(const std::string& text)
{
    return OrderedJson(text).dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

std::string onOneLine(const OrderedJson& value)
{
    if (!value.is_structured()) return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    std::string out;
    for (const auto& item : value.items()) {
        if (!out.empty()) out += ", ";
        if (value.is_object()) out += quoted(item.key()) + ": ";
        out += onOneLine(item.value());
    }
    return value.is_object() ? "{" + out + "}" : "[" + out + "]";
}

/// Appends the value; `before` is how much of the line is taken already.
void append(std::string& out, const OrderedJson& value, std::size_t indent, std::size_t before)
{
    const std::string line = onOneLine(value);
    const bool isTop = indent == 0 && before == 0;
    if (!value.is_structured() || value.empty() || (!isTop && before + line.size() < kLineLength)) {
        out += line;
        return;
    }
    const std::string margin(indent + 2, ' ');
    out += value.is_object() ? '{' : '[';
    bool isFirst = true;
    for (const auto& item : value.items()) {
        out += isFirst ? "\n" : ",\n";
        isFirst = false;
        const std::string head = margin + (value.is_object() ? quoted(item.key()) + ": " : "");
        out += head;
        append(out, item.value(), indent + 2, head.size());
    }
    out += "\n" + std::string(indent, ' ') + (value.is_object() ? '}' : ']');
}

}  // namespace

std::string prettyText(const OrderedJson& value)
{
    std::string out;
    append(out, value, 0, 0);
    return out + "\n";
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
