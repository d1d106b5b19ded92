#pragma once
// Sub-commands of the program. Each is one thin file: options to a struct, one library call. A command registers itself
// on the CLI11 program; its callback runs after parsing and throws Error for what goes wrong (main prints one line and
// exits with 1).

#include <CLI/CLI.hpp>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/progress.h"
#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

struct GlobalOptions {
    bool quiet = false;               // no progress, no summary
    bool verbose = false;             // say what was chosen (device, caches, …)
    std::filesystem::path shaderDir;  // overrides the embedded shaders, for live editing
    std::vector<std::string> words;   // the command line, the program first
};

// All commands with their options. `global` must outlive the program.
void addCommands(CLI::App& program, GlobalOptions& global);

// A bar on a terminal, plain lines otherwise, nothing with --quiet; always on stderr. Work that ends within a second
// shows nothing.
Progress terminalProgress(const GlobalOptions& global);

// Prints warnings on stderr, each line once, unless --quiet.
class WarningPrinter {
public:
    explicit WarningPrinter(const GlobalOptions& global) : quiet_(global.quiet) {}
    void print(const std::vector<std::string>& lines);

private:
    bool quiet_;
    std::set<std::string> printed_;
};

// With --verbose, says how many pyramids came from the cache.
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
