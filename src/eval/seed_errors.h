#pragma once
// Summarises errors of images that differ only in the seed of their lens samples. The range of these errors shows the
// random part of the error.

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>

namespace defocus::engine {

// Error of the image of one seed relative to the reference that all seeds share, computed from display-encoded values.
struct SeedError {
    double rmse = 0;
    double flip = 0;
};

// Returns the min and max error over the seeds as {"seeds": 5, "rmse": {"low": …, "high": …}, "flip": {…}}. Needs at
// least one error.
nlohmann::ordered_json seedErrorsJson(std::span<const SeedError> errors);

}  // namespace defocus::engine
