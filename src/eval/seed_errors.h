#pragma once
// Errors of images that differ in the seed of their lens samples alone: what of an error is chance.

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

namespace defocus::engine {

// Against the same reference, on display-encoded values.
struct SeedError {
    double rmse = 0;
    double flip = 0;
};

// {"seeds": 5, "rmse": {"low": …, "high": …}, "flip": {…}}: from the least to the most. At least one error.
nlohmann::ordered_json seedErrorsJson(std::span<const SeedError> errors);

// The same as columns of a CSV file; without errors they are empty.
inline constexpr const char* seedErrorsColumns = "seeds,rmseLow,rmseHigh,flipLow,flipHigh";
std::string seedErrorsCsv(std::span<const SeedError> errors);

}  // namespace defocus::engine
