// SPDX-License-Identifier: MIT
#include "scene/builtin/builtins.hpp"

#include "scene/nearest.hpp"
#include "scene/read_values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {

namespace scene {

namespace {

const Builtin* findBuiltin(std::string_view name) noexcept
{
    const auto& all = allBuiltins();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Builtin& b) { return b.about.name == name; });
    return found == all.end() ? nullptr : &*found;
}

std::string unknownBuiltin(std::string_view name)
{
    std::vector<std::string> names;
    for (const Builtin& b : allBuiltins()) names.push_back(b.about.name);
    return "no built-in scene has this name" + suggestion(name, names);
}

std::string unknownParameter(const BuiltinScene& about, std::string_view name)
{
    std::vector<std::string> names;
    for (const BuiltinParameter& p : about.parameters) names.push_back(p.name);
    return "no parameter of \"" + about.name + "\" has this name" + suggestion(name, names);
}

std::optional<double> parsedNumber(const std::string& text)
{
    double value = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec != std::errc{} || parsed.ptr != text.data() + text.size()) return std::nullopt;
    return value;
}

/// "1000" and not "1000.000000".
std::string plainText(double value)
{
    return Json(value == std::floor(value) ? Json(static_cast<std::int64_t>(value)) : Json(value)).dump();
}

std::string ruleOf(const BuiltinParameter& p)
{
    switch (p.type) {
    case BuiltinParameterType::Integer:
        return "must be a whole number in [" + plainText(p.least) + ", " + plainText(p.most) + "]";
    case BuiltinParameterType::Number:
        return "must be a number in [" + plainText(p.least) + ", " + plainText(p.most) + "]";
    case BuiltinParameterType::Switch:
        return "must be true or false";
    case BuiltinParameterType::Choice:
        break;
    }
    std::string all = "must be one of ";
    for (const std::string& choice : p.choices) all += (choice == p.choices.front() ? "" : ", ") + choice;
    return all;
}

bool isAllowed(const BuiltinParameter& p, const std::string& text)
{
    if (p.type == BuiltinParameterType::Switch) return text == "true" || text == "false";
    if (p.type == BuiltinParameterType::Choice) {
        return std::find(p.choices.begin(), p.choices.end(), text) != p.choices.end();
    }
    const std::optional<double> value = parsedNumber(text);
    if (!value || !(*value >= p.least && *value <= p.most)) return false;
    return p.type == BuiltinParameterType::Number || *value == std::floor(*value);
}

/// A parameter's value in a scene file has the kind that the parameter has.
bool hasKind(const BuiltinParameter& p, const Json& value)
{
    switch (p.type) {
    case BuiltinParameterType::Switch:
        return value.is_boolean();
    case BuiltinParameterType::Choice:
        return value.is_string();
    case BuiltinParameterType::Integer:
    case BuiltinParameterType::Number:
        break;
    }
    return value.is_number();
}

void setFromNode(Parameters& parameters, const BuiltinScene& about, const Node& node, const std::string& key)
{
    const BuiltinParameter* parameter = parameters.find(key);
    if (parameter == nullptr) node.refuse(unknownParameter(about, key));
    if (!hasKind(*parameter, node.value())) node.refuse(ruleOf(*parameter));
    const std::string text = node.value().is_string() ? node.value().get<std::string>() : node.value().dump();
    if (const auto broken = parameters.set(*parameter, text)) node.refuse(*broken);
}

}  // namespace

const BuiltinParameter* Parameters::find(std::string_view name) const noexcept
{
    for (const BuiltinParameter& p : about_->parameters) {
        if (p.name == name) return &p;
    }
    return nullptr;
}

std::optional<std::string> Parameters::set(const BuiltinParameter& parameter, const std::string& text)
{
    if (!isAllowed(parameter, text)) return ruleOf(parameter);
    given_[parameter.name] = text;
    return std::nullopt;
}

const std::string& Parameters::text(std::string_view name) const
{
    const auto given = given_.find(name);
    return given != given_.end() ? given->second : find(name)->standard;
}

int Parameters::integer(std::string_view name) const
{
    return static_cast<int>(parsedNumber(text(name)).value_or(0));
}

real Parameters::number(std::string_view name) const
{
    return static_cast<real>(parsedNumber(text(name)).value_or(0));
}

std::string Parameters::choice(std::string_view name) const
{
    return text(name);
}

bool Parameters::isOn(std::string_view name) const
{
    return text(name) == "true";
}

std::optional<real> Parameters::numberIfGiven(std::string_view name) const
{
    if (given_.find(name) == given_.end()) return std::nullopt;
    return number(name);
}

WorldDef BuiltinChoice::worldDef(SceneInfo& info) const
{
    WorldDef def;
    info.title = builtin->about.title;
    info.description = builtin->about.doc;
    builtin->prepare(parameters, def, info);
    return def;
}

BuiltinChoice readBuiltin(const Node& node)
{
    std::string name;
    ObjectReader in(node);
    in.require("name", name);
    const Builtin* builtin = findBuiltin(name);
    if (builtin == nullptr) node.child("name").refuse(unknownBuiltin(name));

    BuiltinChoice choice{builtin, Parameters(builtin->about)};
    for (const auto& item : node.value().items()) {
        if (item.key() == "name" || item.key() == "$comment") continue;
        setFromNode(choice.parameters, builtin->about, node.child(item.key()), item.key());
    }
    return choice;
}

const std::vector<Builtin>& allBuiltins()
{
    static const std::vector<Builtin> all = {
        bounceScene(),    cradleScene(), dominoesScene(), gasScene(),   inclineScene(), orbitScene(),
        pendulumsScene(), pileScene(),   pyramidScene(),  stackScene(), tilesScene(),   wreckerScene(),
    };
    return all;
}

}  // namespace scene

const std::vector<BuiltinScene>& builtinScenes()
{
    static const std::vector<BuiltinScene> all = [] {
        std::vector<BuiltinScene> list;
        for (const scene::Builtin& builtin : scene::allBuiltins()) list.push_back(builtin.about);
        return list;
    }();
    return all;
}

Scene makeBuiltinScene(std::string_view specification)
{
    using namespace scene;
    const auto refuse = [&](std::string_view what, std::string_view value, const std::string& rule) {
        throw SceneError(std::string(specification), 0, 0, std::string(what), std::string(value), rule);
    };
    const std::size_t colon = specification.find(':');
    const std::string_view name = specification.substr(0, colon);
    const Builtin* builtin = findBuiltin(name);
    if (builtin == nullptr) refuse("", "", unknownBuiltin(name));

    BuiltinChoice choice{builtin, Parameters(builtin->about)};
    std::string_view rest = colon == std::string_view::npos ? "" : specification.substr(colon + 1);
    while (!rest.empty()) {
        const std::string_view part = rest.substr(0, rest.find(','));
        rest.remove_prefix(std::min(rest.size(), part.size() + 1));
        const std::string_view key = part.substr(0, part.find('='));
        const BuiltinParameter* parameter = choice.parameters.find(key);
        if (parameter == nullptr) refuse(key, "", unknownParameter(builtin->about, key));
        if (key.size() == part.size()) refuse(key, "", "must be given a value: " + std::string(key) + "=...");
        const std::string value(part.substr(key.size() + 1));
        if (const auto broken = choice.parameters.set(*parameter, value)) refuse(key, value, *broken);
    }

    Scene made;
    const WorldDef def = choice.worldDef(made.info);
    made.world = std::make_unique<World>(def);
    choice.build(*made.world);
    return made;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
