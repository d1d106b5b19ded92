#pragma once
// Numbers in JSON, which knows neither NaN nor infinity.

#include <cmath>
#include <nlohmann/json.hpp>

namespace defocus {

// null for what is not finite.
inline nlohmann::json jsonNumber(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace defocus
