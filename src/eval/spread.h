#pragma once
// The middle of repeated measurements and how far they scatter.

#include <vector>

namespace defocus {

struct Spread {
    double median = 0;
    double low = 0;   // 10th percentile
    double high = 0;  // 90th percentile
};

// Percentiles between the values are interpolated linearly (as Hyndman and Fan's type 7). No values: all 0.
Spread spreadOf(std::vector<double> values);

}  // namespace defocus
