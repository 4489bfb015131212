// SPDX-License-Identifier: MIT
// A value of a scene's text together with its path, so that a fault found anywhere in the reader
// can be told by line, path, value and rule.
#pragma once

#include <tamias2d/scene/scene.hpp>

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

using Json = nlohmann::json;

struct Document {
    std::string_view text;
    std::string_view source;  ///< what to call it
};

class Node {
public:
    Node(const Document& document, const Json& value, std::string path = {})
        : document_(&document), value_(&value), path_(std::move(path))
    {
    }

    const Json& value() const noexcept { return *value_; }
    const std::string& path() const noexcept { return path_; }
    const Document& document() const noexcept { return *document_; }

    /// Is this an object that has the key?
    bool has(const std::string& key) const { return value_->is_object() && value_->contains(key); }
    Node child(const std::string& key) const;
    Node child(std::size_t index) const;

    /// @throws SceneError about this value
    [[noreturn]] void refuse(const std::string& rule) const;
    /// @throws SceneError about a fault the library found when given a definition made from this
    /// value. Its field, e.g. "ShapeDef.geometry.radius", leads as deep into the value as it goes.
    [[noreturn]] void refuse(const InputError& error) const;

private:
    const Document* document_;
    const Json* value_;
    std::string path_;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
