#include "eval/seed_errors.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace defocus::engine {

namespace {

struct Ends {
    double low = 0;
    double high = 0;
};

Ends endsOf(std::span<const SeedError> errors, double SeedError::*measure) {
    const auto [min, max] = std::ranges::minmax(errors, {}, measure);
    return {min.*measure, max.*measure};
}

nlohmann::ordered_json endsJson(const Ends& ends) {
    return {{"low", ends.low}, {"high", ends.high}};
}

}  // namespace

nlohmann::ordered_json seedErrorsJson(std::span<const SeedError> errors) {
    return {{"seeds", errors.size()},
            {"rmse", endsJson(endsOf(errors, &SeedError::rmse))},
            {"flip", endsJson(endsOf(errors, &SeedError::flip))}};
}

}  // namespace defocus::engine
