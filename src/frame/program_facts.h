#pragma once
// Identifies the program that made a result.

#include <string>
#include <vector>

namespace defocus::engine {

// Returns the version of the build, such as "0.2.0".
std::string programVersion();

// Returns the commit that the program was built from, followed by "-changed" if the sources differ from that commit.
// Empty for a build outside a git checkout.
std::string programCommit();

// Returns a program's arguments in shell syntax. The program's name is written without folders.
std::string commandLine(std::vector<std::string> words);

}  // namespace defocus::engine
