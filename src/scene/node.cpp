// SPDX-License-Identifier: MIT
#include "scene/node.hpp"

#include "scene/locate.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

/// "ShapeDef.geometry.vertices[3]" -> ShapeDef, geometry, vertices, 3
std::vector<std::string> fieldParts(std::string_view field)
{
    std::vector<std::string> parts(1);
    for (const char c : field) {
        if (c == '.' || c == '[')
            parts.emplace_back();
        else if (c != ']')
            parts.back() += c;
    }
    return parts;
}

/// The value as it is shown in a message; objects and lists of objects would drown it.
std::string shownValue(const Json& value)
{
    if (value.is_object()) return {};
    const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    constexpr std::size_t kLongest = 60;
    return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

/// The key that stands in a scene where the library uses another word.
std::string keyFor(const std::string& part, const Node& at)
{
    if (part == "Tuning") return "tuning";
    if (part == "MassProperties") return "mass";
    if (part == "points") return "vertices";
    if (part.starts_with("lock")) return "locks";
    if (part != "geometry") return part;
    for (const char* kind : {"circle", "capsule", "segment", "box", "polygon", "regularPolygon"}) {
        if (at.has(kind)) return kind;
    }
    return part;
}

bool isIndex(const std::string& part, const Json& list)
{
    return list.is_array() && !part.empty() && part.size() < 9 &&
           part.find_first_not_of("0123456789") == std::string::npos && std::stoul(part) < list.size();
}

}  // namespace

Node Node::child(const std::string& key) const
{
    return {*document_, value_->at(key), path_ + "/" + escapePointer(key)};
}

Node Node::child(std::size_t index) const
{
    return {*document_, value_->at(index), path_ + "/" + std::to_string(index)};
}

void Node::refuse(const std::string& rule) const
{
    const TextPlace place = placeOf(document_->text, findInText(document_->text, path_));
    throw SceneError(std::string(document_->source), place.line, place.column, path_.empty() ? "/" : path_,
                     shownValue(*value_), rule);
}

void Node::refuse(const InputError& error) const
{
    // Parts that have no place of their own in the text (the definition's name, "material",
    // the name of a kind of geometry) are passed over.
    Node at = *this;
    for (const std::string& part : fieldParts(error.field)) {
        const std::string key = keyFor(part, at);
        if (at.has(key))
            at = at.child(key);
        else if (isIndex(part, at.value()))
            at = at.child(std::stoul(part));
    }
    at.refuse(at.path() == path_ ? error.field + " = " + error.value + ": " + error.rule : error.rule);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
