#pragma once
// Compares two results of the same bench row by row. It reports the times that changed by more than their noise, and
// the errors that changed by more than the images of one driver differ.
//
// A time has changed if the spreads of the two (10th to 90th percentile of the runs) don't overlap. The bounds of the
// ratio are those that the spreads allow. Fewer than three runs have no useful spread, so they get no verdict.
//
// An error has changed if it differs by more than 1 %, because on one driver the same program makes the same image. For
// SSIM this is applied to 1 − SSIM, for PSNR to the RMSE that it stands for.
//
// Results of different subjects get no verdict. With another scene, camera, lens, size, device or driver, neither times
// nor errors can be compared; on another machine, times can't; with another reference, errors from it can't.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/bench_results.h"

namespace defocus {

inline constexpr int leastRuns = 3;             // that a verdict on times needs
inline constexpr double errorTolerance = 0.01;  // of the larger error

enum class TimeChange { none, faster, slower, unknown };
enum class ErrorChange { none, closer, farther, unknown };

struct TimeDifference {
    Spread before;  // ms
    Spread after;
    double ratio = 1;       // of the medians, after over before
    double leastRatio = 1;  // the smallest that the spreads allow
    double mostRatio = 1;   // the largest
    TimeChange change = TimeChange::none;
    std::string unknownBecause;  // "one run"; empty unless `change` is unknown
};

struct ErrorDifference {
    double before = 0;
    double after = 0;
    ErrorChange change = ErrorChange::none;
    bool beyondLimit = false;  // `before` is within the error's limit, and `after` is not
};

struct RowDifference {
    std::string key;
    std::optional<TimeDifference> time;             // none if the bench doesn't measure time
    std::map<std::string, ErrorDifference> errors;  // by column; only columns that both results have
};

struct BenchDifference {
    std::vector<std::string> unlike;  // sentences that say how the subjects differ, and what can still be compared
    std::vector<RowDifference> rows;
    std::vector<std::string> onlyBefore;  // keys
    std::vector<std::string> onlyAfter;
};

// Throws Error if the results belong to different benches.
BenchDifference diffBenches(const BenchResults& before, const BenchResults& after);

std::string benchDifferenceTable(const BenchResults& before, const BenchResults& after);

}  // namespace defocus
