#include "capture/shot_schema.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "capture/setting_json.h"
#include "capture/shot.h"

namespace defocus {

namespace {

using Json = nlohmann::ordered_json;

// As a number of JSON, whole where it is whole.
Json numberJson(double value) {
    if (value == static_cast<double>(static_cast<std::int64_t>(value))) return static_cast<std::int64_t>(value);
    return value;
}

Json rangeJson(const char* type, const Setting& setting) {
    return {{"type", type}, {"minimum", numberJson(setting.least)}, {"maximum", numberJson(setting.most)}};
}

// A value of the setting. Forms of their own stand here; a clip is a name or a number, a blade count is 0 or 3 and
// more.
Json valueSchema(const Setting& setting) {
    const Json text = {{"type", "string"}, {"minLength", 1}};
    if (setting.name == "size") {
        const Json side = {{"type", "integer"}, {"minimum", 1}, {"maximum", mostPixels}};
        return {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"items", side}};
    }
    if (setting.name == "background") {
        const Json channel = {{"type", "number"}, {"minimum", 0}, {"maximum", 1'000'000'000}};
        return {{"anyOf",
                 {{{"enum", {"environment", "none"}}},
                  {{"type", "array"}, {"minItems", 3}, {"maxItems", 3}, {"items", channel}}}}};
    }
    if (setting.name == "clip")
        return {{"anyOf", {{{"type", "integer"}, {"minimum", 0}, {"maximum", 1'000'000}}, text}}};
    if (setting.name == "motionSegments") return {{"type", "integer"}, {"minimum", 1}, {"maximum", 64}};
    if (setting.name == "bladeCount")
        return {{"anyOf", {{{"enum", Json::array({0})}}, {{"type", "integer"}, {"minimum", 3}, {"maximum", 64}}}}};
    switch (setting.kind) {
        case SettingKind::number:
            if (!setting.choices.empty())
                return {{"anyOf", {rangeJson("number", setting), {{"enum", setting.choices}}}}};
            return rangeJson("number", setting);
        case SettingKind::whole:
            if (!setting.choices.empty())
                return {{"anyOf", {rangeJson("integer", setting), {{"enum", setting.choices}}}}};
            return rangeJson("integer", setting);
        case SettingKind::truth:
            return {{"type", "boolean"}};
        case SettingKind::choice:
            return {{"enum", setting.choices}};
        case SettingKind::text:
        case SettingKind::path:
        case SettingKind::other:
            break;
    }
    return text;
}

// Values to begin with, of settings that have no default and no choices.
const std::map<std::string_view, Json>& exampleValues() {
    static const std::map<std::string_view, Json> table = {
        {"scene", "scene.glb"},
        {"environment", "studio"},
        {"lightAngle", 5},
        {"lightRadius", 0.1},
        {"clip", "Walk"},
        {"camera", "Camera"},
        {"targetError", 0.003},
        {"blurThreshold", 0.2},
        {"sizeThreshold", 1},
        {"lightThreshold", 0.1},
        {"exposure", "auto"},
        {"focalLength", 50},
        {"fStop", 1.4},
        {"focusDistance", 2.5},
        {"horizontalAperture", 36},
        {"dofEnabled", false},
        {"blurScale", 2},
        {"focusBreathing", true},
        {"exposureTime", 0.02},
        {"iso", 400},
        {"bladeCount", 7},
        {"bladeRotation", 15},
        {"bladeCurvature", 0.5},
        {"anamorphicRatio", 2},
        {"obstruction", 0.3},
        {"sphericalAberration", 0.5},
        {"catEye", 0.5},
        {"axialChromaticAberration", 0.2},
        {"astigmatism", 0.2},
        {"coma", 0.2},
        {"foregroundLimit", 20},
        {"backgroundLimit", 40},
        {"focusRangeFront", 0.5},
        {"focusRangeBehind", 1},
        {"focusRangeRefocuses", true},
        {"focusTilt", 10},
        {"focusSwing", 10},
        {"fieldCurvature", 0.2},
        {"radialBlurGain", 1},
    };
    return table;
}

// None where the choices say all.
std::optional<Json> exampleOf(const Setting& setting) {
    if (const auto found = exampleValues().find(setting.name); found != exampleValues().end()) return found->second;
    if (!setting.choices.empty()) return Json(setting.choices.front());
    return {};
}

// Of a setting whose values change from frame to frame.
Json trackSchema(const Setting& setting) {
    Json value = {{"description", "The value at that frame"}};
    value.update(valueSchema(setting));
    if (const auto example = exampleOf(setting)) value["examples"] = Json::array({*example});
    const Json key = {{"type", "object"},
                      {"additionalProperties", false},
                      {"required", {"frame", "value"}},
                      {"properties", {{"frame", {{"$ref", "#/$defs/frame"}}}, {"value", value}}}};
    const Json keys = {
        {"type", "object"},
        {"additionalProperties", false},
        {"required", Json::array({"keys"})},
        {"properties",
         {{"keys",
           {{"description", "Values at frames; between two of them the value goes from one to the other"},
            {"examples", Json::array({Json::array({{{"frame", 0}, {"value", value["examples"][0]}}})})},
            {"type", "array"},
            {"minItems", 1},
            {"items", key}}},
          {"interpolation", {{"$ref", "#/$defs/interpolation"}}}}}};
    return {{"anyOf", {valueSchema(setting), keys}}};
}

Json schemaOf(const Setting& setting) {
    Json schema = Json::object();
    schema["description"] = setting.unit.empty() ? setting.help : fmt::format("{} ({})", setting.help, setting.unit);
    const std::optional<std::string> standard = setting.text(shotDefaults());
    if (standard)
        schema["default"] = settingJson(setting, *standard);
    else if (const auto example = exampleOf(setting))
        schema["examples"] = Json::array({*example});
    schema.update(setting.keyed ? trackSchema(setting) : valueSchema(setting));
    return schema;
}

// "/animation/clip" → "/properties/animation/properties/clip"
Json::json_pointer schemaPlace(std::string_view place) {
    Json::json_pointer pointer;
    while (!place.empty()) {
        const std::size_t end = std::min(place.find('/', 1), place.size());
        pointer = pointer / "properties" / std::string(place.substr(1, end - 1));
        place.remove_prefix(end);
    }
    return pointer;
}

}  // namespace

nlohmann::ordered_json withSettings(Json schema) {
    for (const Setting& setting : settings())
        if (!setting.shotPlace.empty()) schema[schemaPlace(setting.shotPlace)] = schemaOf(setting);
    return schema;
}

}  // namespace defocus
