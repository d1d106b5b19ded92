#pragma once
// What a bench has written, read back: each row's times and errors, and what they were measured on.
//
// Reads the JSON of bench convergence, speedup, scaling, popping and stability, and the CSV of those that write one.
// Rows belong together by what was asked for (method, setting, samples; sweep, samples, f-number, focus, levels …).

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "eval/spread.h"

namespace defocus {

struct BenchRow {
    std::string key;                       // the asked-for values, parted by spaces
    std::optional<Spread> milliseconds;    // none: the bench times nothing
    int runs = 0;                          // that the times are of; 0: the file doesn't say
    std::map<std::string, double> errors;  // by column: rmse, psnr, flip, … of what the bench measures; finite ones
    std::optional<double> limit;           // of the error, where it has one
    double referenceSamples = 0;           // where each row says those of its reference; 0: it doesn't
};

struct BenchResults {
    std::string bench;       // "convergence", "speedup", …
    std::string measuredOn;  // program, commit, scene, size, device; empty from CSV, which doesn't say
    // What must be alike for the rows to be compared, in words, by name: "scene", "size", "lens fStop", "reference",
    // "machine", …; what the file doesn't say is not there.
    std::map<std::string, std::string> subject;
    std::vector<BenchRow> rows;
};

// `name` is the file's, for messages. Throws Error for a text that is no such result.
BenchResults parseBenchResults(std::string_view text, const std::string& name);

}  // namespace defocus
