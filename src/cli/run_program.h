#pragma once

namespace defocus::engine {

// Runs the program from its command line to its exit code. All exceptions are caught here. An error prints one line on
// stderr; the exit code is 1, or 2 for a wrong command line.
int runProgram(int argc, char** argv);

}  // namespace defocus::engine
