#pragma once
// Describes the program's commands and options as data, read from the same definitions as --help. Completions and the
// man page are written from this data, so that they always match the program.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace defocus::engine {

struct OptionOutline {
    std::vector<std::string> names;  // "-o", "--output"; for a positional argument its word in --help: "SCENE"
    std::string value;               // form of the value, such as "FIRST:LAST"; empty: a flag
    std::vector<std::string> words;  // literal values: "off" of "fractional|off"
    bool list = false;               // several words may be given, separated by commas
    bool file = false;               // value is the name of a file or folder
    bool positional = false;
    std::string description;
    std::string standard;  // default value; may be empty
    std::string group;     // heading in --help, such as "Lens"
    bool shared = false;   // a setting, with the same meaning for each command
};

struct CommandOutline {
    std::vector<std::string> names;  // "bench", "speedup"; empty: the program itself
    std::string description;
    std::string footer;  // examples for --help
    std::vector<OptionOutline> options;
    std::vector<CommandOutline> commands;
};

CommandOutline outlineOf(const CLI::App& program);

// Returns whether --help shows the option. --help-all shows all options, see advanced() in option_text.h.
bool isEveryday(const CLI::Option& option);

// Returns the names of a command, such as "bench speedup".
std::string joinedNames(const CommandOutline& command);

// Returns a command, followed by all commands below it.
std::vector<const CommandOutline*> allCommands(const CommandOutline& command);

}  // namespace defocus::engine
