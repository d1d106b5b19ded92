#pragma once
// Writes scripts with which a shell completes the program's commands, options and values.

#include <string>

#include "cli/options/program_outline.h"

namespace defocus::engine {

// Return scripts for bash 4, zsh 5 and fish 3 or later. Each script is a file for the shell's completion folder.
std::string bashCompletions(const CommandOutline& program);
std::string zshCompletions(const CommandOutline& program);
std::string fishCompletions(const CommandOutline& program);

}  // namespace defocus::engine
