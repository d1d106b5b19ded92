#pragma once
// Computes how long each method takes to reach a given error. Methods whose images differ in both time and error can't
// be compared directly; at equal error, only the time differs.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/convergence/rows.h"

namespace defocus::engine {

inline constexpr std::array comparedErrors{0.01, 0.005, 0.0033};  // root mean squared, of display values in [0, 1]

// A method with those of its settings and numbers of samples that serve best. Accumulation competes twice, at full
// detail and with levels.
struct Competitor {
    std::string name;  // "accumulation with levels", "accumulation at full detail", "embree"
    struct Time {
        double rmse = 0;
        std::optional<double> milliseconds;  // of a frame; none if no row of the competitor comes as close
        bool atMost = false;                 // true: even its fastest row is closer than asked; this is its time
    };
    std::vector<Time> times;  // one for each error asked for, in the same order
};

// Interpolates on each competitor's front, that is among its rows that no other of its rows beats. Between two
// neighbours the error is taken as a power of the time, which is exact for sampling noise of any order. Accumulation
// with levels comes first, the others in order of appearance. Rows with faults don't count. All `errors` must be > 0.
std::vector<Competitor> timesToErrors(std::span<const ConvergenceRow> rows, std::span<const double> errors);

// Returns a table for people: seconds, and their ratio to those of the first competitor. Returns an empty text for
// fewer than two competitors.
std::string equalErrorTable(std::span<const Competitor> competitors);

}  // namespace defocus::engine
