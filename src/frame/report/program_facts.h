#pragma once
// Says which program made a result.

#include <string>
#include <vector>

namespace defocus::engine {

// Returns the version of the build, such as "0.1.0".
std::string programVersion();

// Returns the commit that the program was built from, followed by "-changed" if the sources differ from it. It is empty
// if the program wasn't built in a git checkout.
std::string programCommit();

// Returns a program's arguments as a shell would take them. The program has its name alone, without folders.
std::string commandLine(std::vector<std::string> words);

}  // namespace defocus::engine
