#pragma once
// Sub-commands of the program. Each command has a file of its own, which fills a struct from options and calls the
// library. A command registers itself on the CLI11 program; its callback runs after parsing and throws Error on
// failure. runProgram prints the error as one line and exits with 1, or 2 for a wrong command line.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/progress.h"
#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

struct GlobalOptions {
    bool quiet = false;               // neither progress nor summary
    bool verbose = false;             // print the choices of the program: device, caches, …
    std::filesystem::path shaderDir;  // folder that replaces the embedded shaders, for live editing
    std::vector<std::string> words;   // command line, beginning with the program
};

// Adds all commands with their options. `global` must outlive the program.
void addCommands(CLI::App& program, GlobalOptions& global);

// Returns a command, followed by all commands below it.
std::vector<const CLI::App*> allCommands(const CLI::App& command);

// Returns the names of a command, each after a space, such as " bench speedup"; empty for the program.
std::string pathOf(const CLI::App& command);

// Returns a progress display on stderr: a bar on a terminal, plain lines in a file or pipe, nothing with --quiet. Work
// that ends within a second shows nothing.
Progress terminalProgress(const GlobalOptions& global);

// Prints warnings on stderr, each different line once. Prints nothing with --quiet.
class WarningPrinter {
public:
    explicit WarningPrinter(const GlobalOptions& global) : quiet_(global.quiet) {}
    void print(const std::vector<std::string>& lines);

private:
    bool quiet_;
    std::set<std::string> printed_;
};

// Prints how many pyramids came from the cache, with --verbose only.
void printCacheUse(const PreparedFrame& frame, const GlobalOptions& global);

void addRenderCommand(CLI::App& program, const GlobalOptions& global);
void addViewCommand(CLI::App& program, const GlobalOptions& global);
void addPlanCommand(CLI::App& program, const GlobalOptions& global);
void addInfoCommand(CLI::App& program, const GlobalOptions& global);
void addPyramidCommand(CLI::App& program, const GlobalOptions& global);
void addCompareCommand(CLI::App& program, const GlobalOptions& global);
void addBenchCommand(CLI::App& program, const GlobalOptions& global);
void addCacheCommand(CLI::App& program);
void addSettingsCommand(CLI::App& program);
void addCompletionsCommand(CLI::App& program);
void addManCommand(CLI::App& program);
void addCaptureCommand(CLI::App& program, const GlobalOptions& global);
void addNewShotCommand(CLI::App& program, const GlobalOptions& global);
void addMergeCommand(CLI::App& program, const GlobalOptions& global);

}  // namespace defocus::engine
