// SPDX-License-Identifier: MIT
#include "scene/parse.hpp"

#include "scene/locate.hpp"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

using Json = nlohmann::json;

/// Reads along without keeping values, and stops at the first fault. The library's own tree builder
/// takes the last of two equal keys in silence, and says where a fault is in prose only.
class Checker : public nlohmann::json_sax<Json> {
public:
    Checker(std::string_view text, std::string_view source) : text_(text), source_(source) {}

    bool null() override { return value(); }
    bool boolean(bool) override { return value(); }
    bool number_integer(number_integer_t) override { return value(); }
    bool number_unsigned(number_unsigned_t) override { return value(); }
    bool number_float(number_float_t, const string_t&) override { return value(); }
    bool string(string_t&) override { return value(); }
    bool binary(binary_t&) override { return value(); }
    bool start_object(std::size_t) override { return open(true); }
    bool start_array(std::size_t) override { return open(false); }
    bool end_object() override { return levels_.pop_back(), true; }
    bool end_array() override { return levels_.pop_back(), true; }

    bool key(string_t& name) override
    {
        Level& level = levels_.back();
        level.part = escapePointer(name);
        if (!level.keys.insert(name).second && duplicate_.empty()) duplicate_ = path();
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const Json::exception& fault) override
    {
        // The library's position is one past the byte at fault, or the size at the text's end.
        const std::size_t offset = position == 0 ? 0 : position - 1;
        const TextPlace place = placeOf(text_, offset < text_.size() ? offset : text_.size());
        throw SceneError(source_, place.line, place.column, "", "",
                         "not valid JSON: " + reason(fault.what()));
    }

    const std::string& duplicate() const noexcept { return duplicate_; }

private:
    struct Level {
        bool isObject = false;
        std::string part;       // the key or the index being read
        std::size_t index = 0;  // of the next element
        std::set<std::string> keys;
    };

    bool value()
    {
        if (!levels_.empty() && !levels_.back().isObject) {
            levels_.back().part = std::to_string(levels_.back().index++);
        }
        return true;
    }

    bool open(bool isObject)
    {
        value();
        levels_.push_back({isObject, {}, 0, {}});
        return true;
    }

    std::string path() const
    {
        std::string out;
        for (const Level& level : levels_) out += "/" + level.part;
        return out;
    }

    /// The part of the library's message that a reader of scenes can use.
    static std::string reason(std::string what)
    {
        const std::size_t bracket = what.find("] ");
        if (bracket != std::string::npos) what.erase(0, bracket + 2);
        const std::size_t colon = what.find(": ");
        if (what.starts_with("parse error") && colon != std::string::npos) what.erase(0, colon + 2);
        return what.size() > kLongestReason ? what.substr(0, kLongestReason) + " ..." : what;
    }

    static constexpr std::size_t kLongestReason = 160;

    std::string_view text_;
    std::string source_;
    std::string duplicate_;
    std::vector<Level> levels_;
};

/// The bracket that opens one level too many, if there is one.
std::optional<std::size_t> findTooDeep(std::string_view text)
{
    int depth = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString && c == '\\')
            ++i;
        else if (c == '"')
            inString = !inString;
        else if (!inString && (c == '{' || c == '[') && ++depth > kMaxDepth)
            return i;
        else if (!inString && (c == '}' || c == ']'))
            --depth;
    }
    return std::nullopt;
}

}  // namespace

nlohmann::json parseJson(std::string_view text, std::string_view source)
{
    if (const auto deep = findTooDeep(text)) {
        const TextPlace place = placeOf(text, *deep);
        throw SceneError(std::string(source), place.line, place.column, "", "",
                         "must not be nested deeper than " + std::to_string(kMaxDepth) + " levels");
    }
    Checker checker(text, source);
    Json::sax_parse(text, &checker);
    if (!checker.duplicate().empty()) {
        const TextPlace place = placeOf(text, findInText(text, checker.duplicate()));
        throw SceneError(std::string(source), place.line, place.column, checker.duplicate(), "",
                         "must not be there twice");
    }
    return Json::parse(text);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
