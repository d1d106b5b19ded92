#pragma once
// The program's commands and options as data, read from the command line that --help describes. Completions and the man
// page are written from it, so that they know what the program knows.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace defocus::engine {

struct OptionOutline {
    std::vector<std::string> names;  // "-o", "--output"; the word in --help where it has none: "SCENE"
    std::string value;               // its form, "FIRST:LAST"; empty: a flag
    std::vector<std::string> words;  // values that are words: "off" of "fractional|off"
    bool list = false;               // the words may be given together, parted by commas
    bool file = false;               // takes the name of a file or folder
    bool positional = false;
    std::string description;
    std::string standard;  // the default; may be empty
    std::string group;     // "Lens"
    bool shared = false;   // a setting, which means the same for each command that has it
};

struct CommandOutline {
    std::vector<std::string> names;  // "bench", "speedup"; none: the program itself
    std::string description;
    std::string footer;  // examples
    std::vector<OptionOutline> options;
    std::vector<CommandOutline> commands;
};

CommandOutline outlineOf(const CLI::App& program);

// Returns whether --help shows the option; --help-all shows all, see advanced() in option_text.h.
bool isEveryday(const CLI::Option& option);

// "bench speedup"
std::string joinedNames(const CommandOutline& command);

// A command and all below it, itself first.
std::vector<const CommandOutline*> allCommands(const CommandOutline& command);

}  // namespace defocus::engine
