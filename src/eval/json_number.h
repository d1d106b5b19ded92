#pragma once
// Writes numbers to JSON, which has neither NaN nor infinity.

#include <cmath>
#include <nlohmann/json.hpp>

namespace defocus::engine {

// Returns null for a value that isn't finite.
inline nlohmann::json jsonNumber(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace defocus::engine
