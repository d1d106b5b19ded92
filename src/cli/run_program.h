#pragma once

namespace defocus::engine {

// Runs the program on a command line and returns the exit code. Catches all exceptions: prints the error as one line on
// stderr and returns 1, or 2 for a wrong command line.
int runProgram(int argc, char** argv);

}  // namespace defocus::engine
