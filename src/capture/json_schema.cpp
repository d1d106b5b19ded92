#include "capture/json_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

namespace defocus::engine {

namespace {

using Schema = nlohmann::ordered_json;
using nlohmann::json;

bool acceptsNumber(const Schema& schema, const json& value) {
    if (!value.is_number()) return false;
    const double number = value.get<double>();
    const double infinity = std::numeric_limits<double>::infinity();
    if (!std::isfinite(number) || (schema["type"] == "integer" && number != std::floor(number))) return false;
    return number >= schema.value("minimum", -infinity) && number <= schema.value("maximum", infinity);
}

bool acceptsArray(const Schema& schema, const json& value) {
    if (!value.is_array() || value.size() < schema.value("minItems", std::size_t{0}) ||
        value.size() > schema.value("maxItems", std::numeric_limits<std::size_t>::max()))
        return false;
    return std::ranges::all_of(value, [&](const json& item) { return accepts(schema["items"], item); });
}

// Joins words into a string such as "a", "a or b" or "a, b or c".
std::string alternatives(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    return text;
}

std::string rangeInWords(const Schema& schema) {
    return fmt::format("from {:.10g} to {:.10g}", schema["minimum"].get<double>(), schema["maximum"].get<double>());
}

void addWords(const Schema& schema, std::vector<std::string>& words) {
    if (schema.contains("anyOf")) {
        for (const Schema& each : schema["anyOf"]) addWords(each, words);
    } else if (schema.contains("enum")) {
        for (const Schema& each : schema["enum"]) words.push_back(each.dump());
    } else if (schema["type"] == "boolean") {
        words.emplace_back("true or false");
    } else if (schema["type"] == "string") {
        words.emplace_back("a string");
    } else if (schema["type"] == "array") {
        const Schema& items = schema["items"];
        words.push_back(fmt::format("an array of {} {}s {}", schema["minItems"].get<int>(),
                                    items["type"].get<std::string>(), rangeInWords(items)));
    } else {
        words.push_back((schema["type"] == "integer" ? "an integer " : "a number ") + rangeInWords(schema));
    }
}

}  // namespace

bool accepts(const Schema& schema, const json& value) {
    if (schema.contains("anyOf"))
        return std::ranges::any_of(schema["anyOf"], [&](const Schema& each) { return accepts(each, value); });
    if (schema.contains("enum"))
        return std::ranges::any_of(schema["enum"], [&](const Schema& each) { return json(each) == value; });
    const auto& type = schema["type"];
    if (type == "boolean") return value.is_boolean();
    if (type == "string") return value.is_string() && !value.get_ref<const std::string&>().empty();
    return type == "array" ? acceptsArray(schema, value) : acceptsNumber(schema, value);
}

std::string schemaInWords(const Schema& schema) {
    std::vector<std::string> words;
    addWords(schema, words);
    return alternatives(words);
}

}  // namespace defocus::engine
