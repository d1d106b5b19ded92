#pragma once
// Reads back the results that a bench wrote: the times and errors of each row, and the subject of the measurement.
//
// It reads the JSON files of bench convergence, speedup, scaling, popping and stability, and the CSV files of those
// that write one. Rows of two results are matched by what was asked for (method, setting, samples; sweep, samples,
// f-number, focus, levels …).

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "eval/spread.h"

namespace defocus {

struct BenchRow {
    std::string key;                       // the values that were asked for, separated by spaces
    std::optional<Spread> milliseconds;    // none if the bench doesn't measure time
    int runs = 0;                          // number of runs behind the times; 0 if the file doesn't say
    std::map<std::string, double> errors;  // by column (rmse, psnr, flip, …); finite values only
    std::optional<double> limit;           // largest error that passes, if there is one
    double referenceSamples = 0;           // lens samples of the row's reference; 0 if the row doesn't say
};

struct BenchResults {
    std::string bench;       // "convergence", "speedup", …
    std::string measuredOn;  // program, commit, scene, size, device; empty for CSV, which doesn't say
    // What must agree before rows can be compared, by name: "scene", "size", "lens fStop", "reference", "machine", …
    // Names that the file doesn't mention are missing.
    std::map<std::string, std::string> subject;
    std::vector<BenchRow> rows;
};

// `name` is the name of the file, for messages. Throws Error if the text isn't a result of a bench.
BenchResults parseBenchResults(std::string_view text, const std::string& name);

}  // namespace defocus
