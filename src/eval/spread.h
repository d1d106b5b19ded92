#pragma once
// The middle of repeated measurements and how far they scatter.

#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace defocus {

struct Spread {
    double median = 0;
    double low = 0;   // 10th percentile
    double high = 0;  // 90th percentile
};

// Between the values it is interpolated linearly (Hyndman and Fan's type 7). `share` in [0, 1]; at least one value.
double percentile(std::vector<double> values, double share);

// No values: all 0.
Spread spreadOf(const std::vector<double>& values);

nlohmann::ordered_json spreadJson(const Spread& spread);

}  // namespace defocus
