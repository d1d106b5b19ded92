#pragma once
// The report of a bench: one index.html that needs nothing else, drawn by scripts/report.py (built into the program)
// with Python's matplotlib, as Debian ships it.

#include <filesystem>

namespace defocus {

// The script's text.
const char* reportScript();

// Draws `results`/results.json, with the images it names, into `report`/index.html, and what else lies in `report`:
// speedup.csv, popping.csv, strips.json. False where there is no Python with matplotlib. Throws Error where the script
// fails.
bool writeReport(const std::filesystem::path& results, const std::filesystem::path& report);

}  // namespace defocus
