// SPDX-License-Identifier: MIT
#include "scene/locate.hpp"

#include <nlohmann/json.hpp>

#include <charconv>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

/// Walks over valid JSON text without building anything.
class Scanner {
public:
    explicit Scanner(std::string_view text) : text_(text) {}

    std::size_t at() const noexcept { return at_; }
    bool is(char c) const noexcept { return at_ < text_.size() && text_[at_] == c; }
    void next() noexcept { ++at_; }
    void goTo(std::size_t offset) noexcept { at_ = offset; }

    void skipSpace() noexcept { at_ = minimumOf(text_.find_first_not_of(" \t\r\n", at_)); }

    /// Over a string; returns it with its quotes.
    std::string_view skipString() noexcept
    {
        const std::size_t start = at_++;
        while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
        ++at_;
        return text_.substr(start, at_ - start);
    }

    /// Over a value of any depth, by counting brackets.
    void skipValue() noexcept
    {
        int depth = 0;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '"') {
                skipString();
                if (depth == 0) return;
                continue;
            }
            if (depth == 0 && (c == ',' || c == '}' || c == ']')) return;
            if (c == '{' || c == '[') ++depth;
            if (c == '}' || c == ']') --depth;
            ++at_;
            if (depth == 0 && (c == '}' || c == ']')) return;
        }
    }

private:
    std::size_t minimumOf(std::size_t found) const noexcept
    {
        return found == std::string_view::npos ? text_.size() : found;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

std::string unescapePointer(std::string_view part)
{
    std::string out;
    for (std::size_t i = 0; i < part.size(); ++i) {
        if (part[i] == '~' && i + 1 < part.size()) {
            out += part[++i] == '1' ? '/' : '~';
        } else {
            out += part[i];
        }
    }
    return out;
}

struct Step {
    bool found = false;
    std::size_t start = 0;  // of the key, or of the array's element
    std::size_t value = 0;
};

Step findMember(Scanner& scan, const std::string& key)
{
    Step step;
    for (scan.next(), scan.skipSpace(); !scan.is('}'); scan.skipSpace()) {
        const std::size_t start = scan.at();
        const std::string_view quoted = scan.skipString();
        scan.skipSpace();
        scan.next();  // the colon
        scan.skipSpace();
        const std::string name = nlohmann::json::parse(quoted).get<std::string>();
        if (name == key) step = {true, start, scan.at()};
        scan.skipValue();
        scan.skipSpace();
        if (!scan.is(',')) break;
        scan.next();
    }
    return step;
}

Step findElement(Scanner& scan, const std::string& part)
{
    std::size_t wanted = 0;
    const auto parsed = std::from_chars(part.data(), part.data() + part.size(), wanted);
    if (parsed.ec != std::errc{} || parsed.ptr != part.data() + part.size()) return {};
    scan.next();
    for (std::size_t index = 0;; ++index) {
        scan.skipSpace();
        if (scan.is(']')) return {};
        if (index == wanted) return {true, scan.at(), scan.at()};
        scan.skipValue();
        scan.skipSpace();
        if (!scan.is(',')) return {};
        scan.next();
    }
}

}  // namespace

TextPlace placeOf(std::string_view text, std::size_t offset) noexcept
{
    TextPlace place;
    for (const char c : text.substr(0, offset)) {
        place.line += c == '\n' ? 1 : 0;
        place.column = c == '\n' ? 1 : place.column + 1;
    }
    return place;
}

std::size_t findInText(std::string_view text, std::string_view pointer)
{
    Scanner scan(text);
    scan.skipSpace();
    std::size_t start = scan.at();
    while (!pointer.empty()) {
        pointer.remove_prefix(1);  // the slash
        const std::size_t end = pointer.find('/');
        const std::string part = unescapePointer(pointer.substr(0, end));
        pointer = end == std::string_view::npos ? std::string_view{} : pointer.substr(end);

        Step step;
        if (scan.is('{'))
            step = findMember(scan, part);
        else if (scan.is('['))
            step = findElement(scan, part);
        if (!step.found) return start;
        start = step.start;
        scan.goTo(step.value);
    }
    return start;
}

std::string escapePointer(std::string_view part)
{
    std::string out;
    for (const char c : part) {
        if (c == '~')
            out += "~0";
        else if (c == '/')
            out += "~1";
        else
            out += c;
    }
    return out;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
