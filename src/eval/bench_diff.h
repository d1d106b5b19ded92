#pragma once
// Two results of the same bench, row by row: which times changed by more than their noise, and which errors by more
// than images of one driver differ.
//
// A time has changed where the spreads of the two (10th to 90th percentile of the runs) share no value; the ratio's
// bounds are those that the spreads allow. Fewer than three runs have no spread that says anything: no verdict.
// An error has changed by more than 1 %: on one driver the same program makes the same image. Of SSIM that is what it
// lacks to 1, of PSNR the RMSE that it stands for.
// What was measured on different subjects has no verdict: another scene, camera, lens, size, device or driver leaves
// neither times nor errors to compare, another machine no times, another reference no errors from it.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/bench_results.h"

namespace defocus {

inline constexpr int leastRuns = 3;             // for a verdict on times
inline constexpr double errorTolerance = 0.01;  // of the larger error

enum class TimeChange { none, faster, slower, unknown };
enum class ErrorChange { none, closer, farther, unknown };

struct TimeDifference {
    Spread before;  // ms
    Spread after;
    double ratio = 1;       // of the medians, after over before
    double leastRatio = 1;  // that the spreads allow
    double mostRatio = 1;
    TimeChange change = TimeChange::none;
    std::string unknownBecause;  // "one run"; empty unless `change` is unknown
};

struct ErrorDifference {
    double before = 0;
    double after = 0;
    ErrorChange change = ErrorChange::none;
    bool beyondLimit = false;  // it has a limit, which only `before` keeps
};

struct RowDifference {
    std::string key;
    std::optional<TimeDifference> time;             // none: the bench times nothing
    std::map<std::string, ErrorDifference> errors;  // of the columns that both have
};

struct BenchDifference {
    std::vector<std::string> unlike;  // sentences: what the two were measured on that differs, and what that leaves
    std::vector<RowDifference> rows;
    std::vector<std::string> onlyBefore;  // keys
    std::vector<std::string> onlyAfter;
};

// Throws Error where the two are of different benches.
BenchDifference diffBenches(const BenchResults& before, const BenchResults& after);

std::string benchDifferenceTable(const BenchResults& before, const BenchResults& after);

}  // namespace defocus
