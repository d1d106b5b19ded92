#pragma once
// Computes the time that each method needs to reach a given error. Methods with equal error can be compared by time
// alone.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/convergence/rows.h"

namespace defocus::engine {

inline constexpr std::array comparedErrors{0.01, 0.005, 0.0033};  // RMSE of display values in [0, 1]

// A method in the comparison. Its settings and its number of samples are chosen for each error separately. Accumulation
// counts as two competitors: at full detail and with levels.
struct Competitor {
    std::string name;  // name of the method, such as "accumulation with levels" or "embree"
    struct Time {
        double rmse = 0;                     // the given error
        std::optional<double> milliseconds;  // time to reach `rmse`; nullopt if no frame reaches it
        bool atMost = false;  // true: `milliseconds` is an upper bound, because the fastest frame has a smaller error
    };
    std::vector<Time> times;  // one entry for each of the given errors, in their order
};

// Returns each competitor's times to reach `errors`, which must be > 0. Times are interpolated on the competitor's
// Pareto front. Between neighbouring rows, the error is assumed to be a power function of the time. This assumption is
// exact for sampling noise of any order of convergence. The competitor "accumulation with levels" comes first; the
// other competitors follow in order of appearance. Rows with faults are ignored.
std::vector<Competitor> timesToErrors(std::span<const ConvergenceRow> rows, std::span<const double> errors);

// Returns a text table of seconds and of ratios to the first competitor's time; empty for fewer than two competitors.
std::string equalErrorTable(std::span<const Competitor> competitors);

}  // namespace defocus::engine
