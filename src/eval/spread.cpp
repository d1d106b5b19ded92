#include "eval/spread.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace defocus::engine {

double percentile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    const double rank = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], rank - static_cast<double>(below));
}

Spread spreadOf(const std::vector<double>& values) {
    if (values.empty()) return {};
    return {percentile(values, 0.5), percentile(values, 0.1), percentile(values, 0.9)};
}

nlohmann::ordered_json spreadJson(const Spread& spread) {
    return {{"median", spread.median}, {"low", spread.low}, {"high", spread.high}};
}

}  // namespace defocus::engine
