#pragma once

#include <CLI/CLI.hpp>

#include "cli/command.h"

namespace defocus {

// All commands with their options. `global` must outlive the program.
void addCommands(CLI::App& program, GlobalOptions& global);

// The whole program, from its command line to its exit code: runs one sub-command, and is the only place that catches.
// A fault is one line on stderr and exit code 1, or 2 for a wrong command line.
int runProgram(int argc, char** argv);

}  // namespace defocus
