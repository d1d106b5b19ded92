#include "capture/json_reader.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/suggestion.h"

namespace defocus::engine {

namespace {

using nlohmann::json;

// Returns the value as text for an error message: short, and in valid UTF-8.
std::string shown(const json& value) {
    constexpr std::size_t longest = 40;
    if (value.is_object()) return "an object";
    std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    if (text.size() > longest) text = text.substr(0, longest) + "…";
    return text;
}

// Escapes ~ and / in a key of a JSON pointer (RFC 6901).
std::string escaped(std::string_view key) {
    std::string result;
    for (const char letter : key) {
        if (letter == '~')
            result += "~0";
        else if (letter == '/')
            result += "~1";
        else
            result += letter;
    }
    return result;
}

bool isFiniteNumber(const json& value) {
    return value.is_number() && std::isfinite(value.get<double>());
}

}  // namespace

void JsonReader::failWith(const std::string& message) const {
    fail("{}: {}: {}", file_, pointer_.empty() ? "/" : pointer_, message);
}

void JsonReader::failExpecting(const std::string& what) const {
    failWith(fmt::format("expected {}, not {}", what, shown(*value_)));
}

void JsonReader::requireObject(const std::vector<std::string>& known) const {
    if (!value_->is_object()) failExpecting("an object");
    for (const auto& [key, member] : value_->items()) {
        if (std::ranges::find(known, key) != known.end()) continue;
        const std::string nearest = nearestWord(key, known);
        if (!nearest.empty()) failWith(fmt::format("there is no key '{}'; did you mean '{}'?", key, nearest));
        failWith(fmt::format("there is no key '{}'; the keys are: {}", key, fmt::join(known, ", ")));
    }
}

JsonReader JsonReader::at(const char* key) const {
    const auto found = find(key);
    if (!found) failWith(fmt::format("'{}' is missing", key));
    return *found;
}

std::optional<JsonReader> JsonReader::find(const char* key) const {
    const auto found = value_->find(key);
    if (found == value_->end()) return {};
    return JsonReader(*found, file_, pointer_ + '/' + escaped(key));
}

std::vector<std::pair<std::string, JsonReader>> JsonReader::members() const {
    std::vector<std::pair<std::string, JsonReader>> result;
    for (const auto& [key, member] : value_->items())
        result.emplace_back(key, JsonReader(member, file_, pointer_ + '/' + escaped(key)));
    return result;
}

std::vector<JsonReader> JsonReader::elements(std::size_t min, const std::string& what) const {
    if (!value_->is_array() || value_->size() < min) failExpecting(what);
    std::vector<JsonReader> result;
    for (auto& [index, reader] : members()) result.push_back(std::move(reader));
    return result;
}

double JsonReader::number(double min, double max) const {
    const double number = isFiniteNumber(*value_) ? value_->get<double>() : std::nan("");
    if (!(number >= min && number <= max)) failExpecting(fmt::format("a number from {} to {}", min, max));
    return number;
}

std::int64_t JsonReader::integer(std::int64_t min, std::int64_t max) const {
    const double number = isFiniteNumber(*value_) ? value_->get<double>() : std::nan("");
    const bool inside = number >= static_cast<double>(min) && number <= static_cast<double>(max);
    if (!inside || number != std::floor(number)) failExpecting(fmt::format("an integer from {} to {}", min, max));
    return static_cast<std::int64_t>(number);
}

bool JsonReader::boolean() const {
    if (!value_->is_boolean()) failExpecting("true or false");
    return value_->get<bool>();
}

std::string JsonReader::text() const {
    if (!value_->is_string() || value_->get_ref<const std::string&>().empty()) failExpecting("a string");
    return value_->get<std::string>();
}

std::size_t JsonReader::choice(const std::vector<std::string>& choices) const {
    const auto found =
        value_->is_string() ? std::ranges::find(choices, value_->get_ref<const std::string&>()) : choices.end();
    if (found == choices.end()) {
        std::string listed;
        for (std::size_t i = 0; i < choices.size(); ++i)
            listed += (i == 0 ? "" : i + 1 == choices.size() ? " or " : ", ") + ('"' + choices[i] + '"');
        failExpecting(listed);
    }
    return static_cast<std::size_t>(found - choices.begin());
}

std::optional<std::vector<double>> JsonReader::threeNumbers() const {
    if (!value_->is_array() || value_->size() != 3 || !std::ranges::all_of(*value_, isFiniteNumber)) return {};
    return value_->get<std::vector<double>>();
}

}  // namespace defocus::engine
