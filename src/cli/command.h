#pragma once
// Declares functions that the sub-commands of the program share. Each command's file registers the command with CLI11
// and fills a struct from the command's options. A callback runs after parsing, calls the library and throws Error on
// failure. runProgram prints the error as one line and exits with 1, or with 2 for a wrong command line.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/progress.h"
#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

struct GlobalOptions {
    bool quiet = false;               // print neither progress nor a summary
    bool verbose = false;             // also print the device, the use of caches and automatic choices
    std::filesystem::path shaderDir;  // folder whose shaders replace the embedded ones, for live editing
    std::vector<std::string> words;   // command line, beginning with the program's name
};

// Adds all commands with their options. `global` must outlive `program`.
void addCommands(CLI::App& program, GlobalOptions& global);

// Returns a command followed by all its direct and indirect sub-commands.
std::vector<const CLI::App*> allCommands(const CLI::App& command);

// Returns the names of the command and its parent commands, each preceded by a space, such as " bench speedup"; empty
// for the program itself.
std::string pathOf(const CLI::App& command);

// Returns a progress display on stderr: a bar on a terminal, plain lines in a file or pipe, nothing with --quiet. Work
// that takes less than a second shows nothing.
Progress terminalProgress(const GlobalOptions& global);

// Prints warnings on stderr, each distinct line once; prints nothing with --quiet.
class WarningPrinter {
public:
    explicit WarningPrinter(const GlobalOptions& global) : quiet_(global.quiet) {}
    void print(const std::vector<std::string>& lines);

private:
    bool quiet_;
    std::set<std::string> printed_;
};

// Prints how many mesh pyramids were read from the cache, but only with --verbose.
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
void addExportCameraCommand(CLI::App& program, const GlobalOptions& global);
void addMergeCommand(CLI::App& program, const GlobalOptions& global);
void addRefocusCommand(CLI::App& program, const GlobalOptions& global);

}  // namespace defocus::engine
