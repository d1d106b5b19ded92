#pragma once
// Measures numerically stiff and extreme cases. Each case names the measured error, the reference and the max error,
// which is fixed in advance. The benchmark prints the cases, and a test checks their limits.

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/progress.h"

namespace defocus::engine {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

struct StabilityCase {
    std::string area;       // "sums", "lens", "motion", "space", "values", "levels", "traced"
    std::string name;       // what makes it stiff or extreme
    std::string measured;   // what the error measures, with its unit
    std::string reference;  // "closed form", "double sum", …
    double limit = 0;       // the largest error that passes; infinity if the case is for comparison only
    std::function<double()> error;
    std::string method = {};  // method that renders the reference; empty if none does
};

struct StabilityRow {
    StabilityCase subject;
    double error = 0;
    bool leftOut = false;  // true if this program lacks the reference's method
    [[nodiscard]] bool failed() const { return !leftOut && !(error <= subject.limit); }  // a NaN fails
};

// Returns all cases. Calling their `error` needs a current GL context.
std::vector<StabilityCase> stabilityCases();

void measureStability(const std::function<void(const StabilityRow&)>& visit, const Progress& progress = {});

// The parts of stabilityCases, one for each file.
void addSumCases(std::vector<StabilityCase>& cases);
void addLensCases(std::vector<StabilityCase>& cases);
void addEdgeCases(std::vector<StabilityCase>& cases);
void addMotionCases(std::vector<StabilityCase>& cases);
void addSpaceCases(std::vector<StabilityCase>& cases);
void addValueCases(std::vector<StabilityCase>& cases);
void addSplitCases(std::vector<StabilityCase>& cases);
void addLevelCases(std::vector<StabilityCase>& cases);
void addTracedCases(std::vector<StabilityCase>& cases);

}  // namespace defocus::engine
