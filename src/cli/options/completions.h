#pragma once
// Scripts that let a shell complete the program's commands, options and values.

#include <string>

#include "cli/options/program_outline.h"

namespace defocus::engine {

// For bash 4 and later, zsh 5 and fish 3; each is a file for the folder from which the shell loads such scripts.
std::string bashCompletions(const CommandOutline& program);
std::string zshCompletions(const CommandOutline& program);
std::string fishCompletions(const CommandOutline& program);

}  // namespace defocus::engine
