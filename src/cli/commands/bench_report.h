#pragma once
// Writes the report of a `defocus bench` command: a single, self-contained index.html. Python modules of bench/figures,
// which are embedded in the program, draw its plots with matplotlib.

#include <filesystem>

#include "cli/command.h"

namespace defocus::engine {

// Returns the source of the Python script that writes the report.
const char* reportScript();

// Adds the option --report FOLDER, which excludes `output`, the command's option -o. The result files and the report's
// page are written to FOLDER.
void addReport(CLI::App& command, CLI::Option* output, std::filesystem::path& report);

// Writes `report`/index.html from `results`/results.json and from the results of other bench commands in `report`.
// Prints the page's path, or that matplotlib is missing. Does nothing if `report` is empty. Throws Error if the script
// fails.
void drawReport(const std::filesystem::path& results, const std::filesystem::path& report);

}  // namespace defocus::engine
