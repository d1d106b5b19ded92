#include "capture/shot_schema.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "capture/setting_json.h"
#include "capture/shot.h"

namespace defocus::engine {

namespace {

using Json = nlohmann::ordered_json;

// Returns an example value of a setting; nullopt if the setting has neither an example nor choices.
std::optional<Json> exampleOf(const Setting& setting) {
    if (!setting.example.empty()) return settingJson(setting, setting.example);
    if (!setting.choices.empty()) return Json(setting.choices.front());
    return {};
}

// Returns the schema of a setting that may be animated: it accepts a value or keyframes.
Json trackSchema(const Setting& setting) {
    Json value = {{"description", "Value at this frame"}};
    value.update(valueSchema(setting));
    if (const auto example = exampleOf(setting)) value["examples"] = Json::array({*example});
    const Json key = {{"type", "object"},
                      {"additionalProperties", false},
                      {"required", {"frame", "value"}},
                      {"properties", {{"frame", {{"$ref", "#/$defs/frame"}}}, {"value", value}}}};
    const Json keys = {{"type", "object"},
                       {"additionalProperties", false},
                       {"required", Json::array({"keys"})},
                       {"properties",
                        {{"keys",
                          {{"description", "Keyframes; between two keyframes, the value is interpolated"},
                           {"examples", Json::array({Json::array({{{"frame", 0}, {"value", value["examples"][0]}}})})},
                           {"type", "array"},
                           {"minItems", 1},
                           {"items", key}}},
                         {"interpolation", {{"$ref", "#/$defs/interpolation"}}}}}};
    return {{"anyOf", {valueSchema(setting), keys}}};
}

Json schemaOf(const Setting& setting) {
    Json schema = Json::object();
    schema["description"] = setting.help;
    const std::optional<std::string> defaultValue = setting.text(shotDefaults());
    if (defaultValue)
        schema["default"] = settingJson(setting, *defaultValue);
    else if (const auto example = exampleOf(setting))
        schema["examples"] = Json::array({*example});
    schema.update(setting.keyed ? trackSchema(setting) : valueSchema(setting));
    return schema;
}

// Converts a location in a shot to the location in the schema: "/animation/clip" →
// "/properties/animation/properties/clip".
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

}  // namespace defocus::engine
