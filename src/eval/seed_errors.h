#pragma once
// Errors of images that differ only in the seed of their lens samples. Their range is the random part of an error.

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

namespace defocus::engine {

// Error of one seed's image against the common reference, on display-encoded values.
struct SeedError {
    double rmse = 0;
    double flip = 0;
};

// Returns the min and max as {"seeds": 5, "rmse": {"low": …, "high": …}, "flip": {…}}. Needs at least one error.
nlohmann::ordered_json seedErrorsJson(std::span<const SeedError> errors);

// Header and fields of the same values in a CSV file; the fields are empty without errors.
inline constexpr const char* seedErrorsColumns = "seeds,rmseLow,rmseHigh,flipLow,flipHigh";
std::string seedErrorsCsv(std::span<const SeedError> errors);

}  // namespace defocus::engine
