#pragma once
// Converts numbers to JSON (null for NaN and infinity, which JSON does not support), and JSON to text.

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace defocus::engine {

// Returns the number as JSON; null for NaN and infinity.
inline nlohmann::ordered_json jsonNumber(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

// Returns the JSON as UTF-8 text that ends with a line break. Invalid UTF-8 in strings becomes U+FFFD.
inline std::string documentText(const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace defocus::engine
