#pragma once
// Measures numerically difficult and extreme cases. Each case states the measured error, the reference and the max
// error, which is fixed in advance. The benchmark prints the cases; a test checks the limits.

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/progress.h"

namespace defocus::engine {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

struct StabilityCase {
    std::string area;       // tested area: "sums", "lens", "motion", "space", "values", "levels", "traced"
    std::string name;       // short description of what makes the case difficult
    std::string measured;   // name and unit of the measured error
    std::string reference;  // name of the exact or comparison value, such as "closed form" or "double sum"
    double limit = 0;       // max error that passes; infinity: the error is only shown for comparison
    std::function<double()> error;
    std::string method = {};  // method that renders the reference; empty: none
};

struct StabilityRow {
    StabilityCase subject;
    double error = 0;
    bool leftOut = false;  // true: not measured, because this build lacks StabilityCase::method
    [[nodiscard]] bool failed() const { return !leftOut && !(error <= subject.limit); }  // a NaN error fails
};

// Returns all cases. Measuring a case (StabilityCase::error) needs a current GL context.
std::vector<StabilityCase> stabilityCases();

void measureStability(const std::function<void(const StabilityRow&)>& visit, const Progress& progress = {});

// Each function below adds the cases of one source file to stabilityCases().
void addSumCases(std::vector<StabilityCase>& cases);
void addLensCases(std::vector<StabilityCase>& cases);
void addEdgeCases(std::vector<StabilityCase>& cases);
void addMotionCases(std::vector<StabilityCase>& cases);
void addSpaceCases(std::vector<StabilityCase>& cases);
void addValueCases(std::vector<StabilityCase>& cases);
void addSplitCases(std::vector<StabilityCase>& cases);
void addTracedCases(std::vector<StabilityCase>& cases);

}  // namespace defocus::engine
