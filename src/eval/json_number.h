#pragma once
// Converts numbers to JSON, which supports neither NaN nor infinity.

#include <cmath>
#include <nlohmann/json.hpp>

namespace defocus::engine {

// Returns the number as JSON; null for NaN and infinity.
inline nlohmann::json jsonNumber(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace defocus::engine
