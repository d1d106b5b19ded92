#pragma once
// Stiff and extreme cases, each with what is measured, against which truth, and a limit that stands in the code before
// anything is measured. The benchmark prints them; a test holds them.

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/progress.h"

namespace defocus {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

struct StabilityCase {
    std::string area;      // "sums", "lens", "motion", "space", "values", "levels", "traced"
    std::string name;      // what is stiff about it
    std::string measured;  // what the error is of, with its unit
    std::string truth;     // "closed form", "double sum", …
    double limit = 0;      // the largest error that passes; infinity: for comparison only
    std::function<double()> error;
    std::string method = {};  // of the table of methods, that the truth is; empty: none
};

struct StabilityRow {
    StabilityCase subject;
    double error = 0;
    bool leftOut = false;  // this program doesn't have the case's method
    [[nodiscard]] bool failed() const { return !leftOut && !(error <= subject.limit); }  // a NaN fails
};

// Needs a current GL context while they are measured.
std::vector<StabilityCase> stabilityCases();

void measureStability(const std::function<void(const StabilityRow&)>& visit, const Progress& progress = {});

// The parts of stabilityCases, one a file.
void addSumCases(std::vector<StabilityCase>& cases);
void addLensCases(std::vector<StabilityCase>& cases);
void addEdgeCases(std::vector<StabilityCase>& cases);
void addMotionCases(std::vector<StabilityCase>& cases);
void addSpaceCases(std::vector<StabilityCase>& cases);
void addValueCases(std::vector<StabilityCase>& cases);
void addSplitCases(std::vector<StabilityCase>& cases);
void addLevelCases(std::vector<StabilityCase>& cases);
void addTracedCases(std::vector<StabilityCase>& cases);

}  // namespace defocus
