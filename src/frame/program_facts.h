#pragma once
// Identifies the program that produced a result: version, commit and command line.

#include <string>
#include <vector>

namespace defocus::engine {

// Returns the program's version, such as "0.2.0".
std::string programVersion();

// Returns the commit that the program was built from, followed by "-changed" if the sources differ from that commit.
// Empty for a build outside a git checkout.
std::string programCommit();

// Quotes a word for the shell. Returns the word unchanged if it needs no quotes, else in single quotes.
std::string shellWord(const std::string& word);

// Returns program arguments as one command line in shell syntax. The program's name is written without folders.
std::string commandLine(std::vector<std::string> words);

}  // namespace defocus::engine
