#pragma once
// Summarises repeated measurements by their median and their scatter.

#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace defocus::engine {

struct Spread {
    double median = 0;
    double low = 0;   // 10th percentile
    double high = 0;  // 90th percentile
};

// Returns the value below which `share` ∈ [0, 1] of the values lie. It interpolates linearly between two values
// (Hyndman and Fan 1996, type 7) and needs at least one.
double percentile(std::vector<double> values, double share);

// Without values, all of the result is 0.
Spread spreadOf(const std::vector<double>& values);

nlohmann::ordered_json spreadJson(const Spread& spread);

}  // namespace defocus::engine
