#pragma once
// What a result says about the program that made it.

#include <string>
#include <vector>

namespace defocus {

// "0.1.0", of the build.
std::string programVersion();

// The commit that the program was built from, "-changed" added where the sources differ from it; empty where it wasn't
// built in a git checkout.
std::string programCommit();

// A program's arguments as a shell would take them, the program by its name alone.
std::string commandLine(std::vector<std::string> words);

}  // namespace defocus
