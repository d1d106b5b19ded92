#pragma once
// The part of JSON Schema that values of settings need: anyOf, enum, and type with the limits of numbers, strings and
// arrays.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace defocus::engine {

bool accepts(const nlohmann::ordered_json& schema, const nlohmann::json& value);

// Returns what the schema accepts, in words: "an integer from 1 to 64", "\"auto\" or a number from 0 to 1".
std::string schemaInWords(const nlohmann::ordered_json& schema);

}  // namespace defocus::engine
