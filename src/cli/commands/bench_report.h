#pragma once
// The report of a bench: a single, self-contained index.html. Python modules in bench/figures draw it with matplotlib;
// the program embeds them.

#include <filesystem>

#include "cli/command.h"

namespace defocus::engine {

// Returns the Python script that draws the report.
const char* reportScript();

// Adds --report FOLDER, which excludes `output`, the command's -o. The result files and the page go to that folder.
void addReport(CLI::App& command, CLI::Option* output, std::filesystem::path& report);

// Draws `results`/results.json and the results of other benches in `report` as `report`/index.html. Prints the page's
// path, or that matplotlib is missing. Does nothing for an empty `report`. Throws Error if the script fails.
void drawReport(const std::filesystem::path& results, const std::filesystem::path& report);

}  // namespace defocus::engine
