#pragma once
// Draws the report of a bench: a single, self-contained index.html. Python modules of bench/figures, which are embedded
// in the program, draw it with matplotlib.

#include <filesystem>

#include "cli/command.h"

namespace defocus::engine {

// Returns the source of the Python script that draws the report.
const char* reportScript();

// Adds the option --report FOLDER, which excludes `output`, the command's option -o. The result files and the report's
// page are written to FOLDER.
void addReport(CLI::App& command, CLI::Option* output, std::filesystem::path& report);

// Draws `report`/index.html from `results`/results.json and from the results of other benches in `report`. Prints the
// page's path, or that matplotlib is missing. Does nothing if `report` is empty. Throws Error if the script fails.
void drawReport(const std::filesystem::path& results, const std::filesystem::path& report);

}  // namespace defocus::engine
