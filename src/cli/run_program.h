#pragma once

namespace defocus::engine {

// The whole program, from its command line to its exit code: runs one sub-command, and is the only place that catches.
// A fault is one line on stderr and exit code 1, or 2 for a wrong command line.
int runProgram(int argc, char** argv);

}  // namespace defocus::engine
