#pragma once
// Computes how long each method takes to reach a given error. At equal error, methods differ in time alone and are
// comparable.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/convergence/rows.h"

namespace defocus::engine {

inline constexpr std::array comparedErrors{0.01, 0.005, 0.0033};  // root mean squared, of display values in [0, 1]

// A method with its best settings and number of samples for each error. Accumulation competes twice, at full detail and
// with levels.
struct Competitor {
    std::string name;  // "accumulation with levels", "accumulation at full detail", "embree"
    struct Time {
        double rmse = 0;
        std::optional<double> milliseconds;  // of a frame; unset if no row of the competitor reaches the error
        bool atMost = false;                 // true: an upper bound, because even the fastest row has a smaller error
    };
    std::vector<Time> times;  // one for each requested error, in the same order
};

// Returns each competitor's times to the `errors`, which must be > 0. Times are interpolated on the competitor's Pareto
// front. Between neighbouring rows the error is a power of the time, which is exact for sampling noise of any order.
// Accumulation with levels comes first, the others in order of appearance. Rows with faults don't count.
std::vector<Competitor> timesToErrors(std::span<const ConvergenceRow> rows, std::span<const double> errors);

// Returns a text table of seconds and their ratios to the first competitor's. Returns an empty text for fewer than two
// competitors.
std::string equalErrorTable(std::span<const Competitor> competitors);

}  // namespace defocus::engine
