#include "capture/setting_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "capture/json_schema.h"
#include "core/error.h"
#include "core/parse.h"

namespace defocus::engine {

namespace {

using Json = nlohmann::ordered_json;

// Returns a JSON integer for an integral value, else a JSON number.
Json numberJson(double value) {
    if (value == static_cast<double>(static_cast<std::int64_t>(value))) return static_cast<std::int64_t>(value);
    return value;
}

Json rangeJson(const char* type, const Setting& setting) {
    return {{"type", type}, {"minimum", numberJson(setting.min)}, {"maximum", numberJson(setting.max)}};
}

std::string textOf(const nlohmann::json& value, char arraySeparator) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number()) {
        const Json number = numberJson(value.get<double>());
        return number.is_number_integer() ? number.dump() : fmt::format("{}", number.get<double>());
    }
    if (!value.is_array()) return value.dump();
    std::string text;
    for (const nlohmann::json& element : value) {
        if (!text.empty()) text += arraySeparator;
        text += textOf(element, arraySeparator);
    }
    return text;
}

// Returns a JSON number if the text is a number, else a JSON string.
Json numberOr(const std::string& text) {
    const Json number = Json::parse(text, nullptr, false);
    return number.is_number() ? numberJson(number.get<double>()) : Json(text);
}

}  // namespace

Json valueSchema(const Setting& setting) {
    if (!setting.schema.empty()) return Json::parse(setting.schema);
    switch (setting.kind) {
        case SettingKind::number:
        case SettingKind::integer: {
            const Json range = rangeJson(setting.kind == SettingKind::number ? "number" : "integer", setting);
            if (setting.choices.empty()) return range;
            return {{"anyOf", {range, {{"enum", setting.choices}}}}};
        }
        case SettingKind::boolean:
            return {{"type", "boolean"}};
        case SettingKind::choice:
            return {{"enum", setting.choices}};
        case SettingKind::text:
        case SettingKind::path:
        case SettingKind::other:
            break;
    }
    return {{"type", "string"}, {"minLength", 1}};
}

std::string settingText(const Setting& setting, const JsonReader& reader) {
    const Json schema = valueSchema(setting);
    if (!accepts(schema, reader.value())) reader.failExpecting(schemaInWords(schema));
    std::string text = textOf(reader.value(), setting.arraySeparator);
    try {
        Request scratch;
        setting.set(scratch, text);
    } catch (const Error& error) {
        reader.failWith(error.what());
    }
    return text;
}

Json settingJson(const Setting& setting, const std::string& text) {
    const Json schema = valueSchema(setting);
    for (const Json& value : {Json(text == "true"), numberOr(text), Json(text)})
        if (accepts(schema, value)) return value;
    Json array = Json::array();
    for (const std::string& part : splitAt(text, setting.arraySeparator)) array.push_back(numberOr(part));
    return array;
}

}  // namespace defocus::engine
