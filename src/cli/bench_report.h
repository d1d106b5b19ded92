#pragma once
// The report of a bench: one index.html that needs nothing else, drawn by scripts/report.py (built into the program)
// with Python's matplotlib, as Debian ships it.

#include <filesystem>

#include "cli/command.h"

namespace defocus {

// The script's text.
const char* reportScript();

// --report FOLDER instead of `output`, the command's -o: its files go there, and the page with them.
void addReport(CLI::App& command, CLI::Option* output, std::filesystem::path& report);

// Draws what benches have left in `report` (and `results`/results.json, with the images it names) as
// `report`/index.html, and says where it is, or that there is no Python with matplotlib. Nothing for an empty path.
// Throws Error where the script fails.
void drawReport(const std::filesystem::path& results, const std::filesystem::path& report);

}  // namespace defocus
