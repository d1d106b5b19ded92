#pragma once
// Summarises repeated measurements by their median and percentiles.

#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace defocus::engine {

struct Spread {
    double median = 0;
    double low = 0;   // 10th percentile of the measurements
    double high = 0;  // 90th percentile of the measurements
};

// Returns the value below which a fraction `share` ∈ [0, 1] of the values lies, with linear interpolation between two
// values (Hyndman and Fan 1996, type 7). Needs at least one value.
double percentile(std::vector<double> values, double share);

// Returns the spread of the values; all zeros if there are none.
Spread spreadOf(const std::vector<double>& values);

nlohmann::ordered_json spreadJson(const Spread& spread);

}  // namespace defocus::engine
