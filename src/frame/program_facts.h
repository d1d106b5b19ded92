#pragma once
// What a result says about the program that made it.

#include <string>

namespace defocus {

// "0.1.0", of the build.
std::string programVersion();

// The commit that the program was built from, "-changed" added where the sources differ from it; empty where it wasn't
// built in a git checkout.
std::string programCommit();

// The command line of this process as a shell would take it, the program by its name alone; empty where the system
// doesn't tell.
std::string commandLine();

}  // namespace defocus
