#pragma once
// How long does each competitor take to come as close to the reference as a given error? What compares methods whose
// frames differ in both time and error: at equal error, one has time alone to look at.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/convergence/rows.h"

namespace defocus {

inline constexpr std::array comparedErrors{0.01, 0.005, 0.0033};  // root mean squared, of display values in [0, 1]

// A method with whatever of its settings and numbers of samples serve best. Accumulation competes twice, at full detail
// and with levels.
struct Competitor {
    std::string name;  // "accumulation with levels", "accumulation at full detail", "embree"
    struct Time {
        double rmse = 0;
        std::optional<double> milliseconds;  // a frame; none: no row of the competitor comes as close
        bool atMost = false;                 // even its fastest row is closer than asked, and takes this long
    };
    std::vector<Time> times;  // one for each error asked for, in their order
};

// Between the neighbours on a competitor's front (its rows that no other of its rows beats) the error is a power of the
// time: exact for sampling noise of any order. In order of appearance, accumulation with levels first; rows with faults
// don't count. `errors` > 0.
std::vector<Competitor> timesToErrors(std::span<const ConvergenceRow> rows, std::span<const double> errors);

// A table for people: seconds, and how many times those of the first competitor; empty for fewer than two.
std::string equalErrorTable(std::span<const Competitor> competitors);

}  // namespace defocus
