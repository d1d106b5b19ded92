#pragma once
// Checks JSON values against the subset of JSON Schema that settings use, and describes such schemas in words. The
// subset is anyOf, enum, and type with limits for numbers, strings and arrays.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace defocus::engine {

bool accepts(const nlohmann::ordered_json& schema, const nlohmann::json& value);

// Describes the values that the schema accepts, such as "an integer from 1 to 64" or "\"auto\" or a number from 0 to
// 1".
std::string schemaInWords(const nlohmann::ordered_json& schema);

}  // namespace defocus::engine
