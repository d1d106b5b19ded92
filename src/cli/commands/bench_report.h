#pragma once
// The report of a bench: one index.html without other files. Modules of bench/figures draw it with matplotlib; the
// program contains them.

#include <filesystem>

#include "cli/command.h"

namespace defocus::engine {

// Returns the text of the script that draws the report.
const char* reportScript();

// --report FOLDER instead of `output`, the command's -o: its files go there, and the page with them.
void addReport(CLI::App& command, CLI::Option* output, std::filesystem::path& report);

// Draws `results`/results.json and the results of other benches in `report` as `report`/index.html, and prints its
// path or that matplotlib is missing. Does nothing for an empty path. Throws Error if the script fails.
void drawReport(const std::filesystem::path& results, const std::filesystem::path& report);

}  // namespace defocus::engine
