#pragma once
// Two results of the same bench, row by row: which times changed by more than their noise, and how the errors moved.
//
// Reads what bench convergence and bench speedup write, CSV or JSON. A time has changed where the spreads of the two
// (10th to 90th percentile of the runs) share no value; the ratio's bounds are those that the spreads allow. Rows
// belong together by what was asked for (method, setting, samples; or sweep, samples, f-number, focus, levels).

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "eval/spread.h"

namespace defocus {

struct BenchRow {
    std::string key;  // the asked-for values, parted by spaces
    Spread milliseconds;
    std::map<std::string, double> errors;  // by column: psnr, flip, … of what the bench measures; finite ones
};

struct BenchResults {
    std::string bench;       // "convergence" or "speedup"
    std::string measuredOn;  // program, commit, scene, size, device; empty from CSV, which doesn't say
    std::vector<BenchRow> rows;
};

// `name` is the file's, for messages. Throws Error for a text that is no such result.
BenchResults parseBenchResults(std::string_view text, const std::string& name);

enum class TimeChange { none, faster, slower };

struct RowDifference {
    std::string key;
    Spread before;  // ms
    Spread after;
    double ratio = 1;       // of the medians, after over before
    double leastRatio = 1;  // that the spreads allow
    double mostRatio = 1;
    TimeChange change = TimeChange::none;
    std::map<std::string, double> errors;  // after minus before, of the columns that both have
};

struct BenchDifference {
    std::vector<RowDifference> rows;
    std::vector<std::string> onlyBefore;  // keys
    std::vector<std::string> onlyAfter;
};

// Throws Error where the two are of different benches.
BenchDifference diffBenches(const BenchResults& before, const BenchResults& after);

std::string benchDifferenceTable(const BenchResults& before, const BenchResults& after);

}  // namespace defocus
