#pragma once
// Sub-commands of the program. Each is one thin file: options to a struct, one library call. A command registers itself
// on the CLI11 program; its callback runs after parsing and throws Error for what goes wrong (main prints one line and
// exits with 1).

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "core/progress.h"

namespace defocus {

struct GlobalOptions {
    bool quiet = false;               // no progress, no summary
    bool verbose = false;             // say what was chosen (device, caches, …)
    std::filesystem::path shaderDir;  // overrides the embedded shaders, for live editing
};

// "0.1.0", of the build.
std::string programVersion();

// A bar on a terminal, plain lines otherwise, nothing with --quiet; always on stderr. Work that ends within a second
// shows nothing.
Progress terminalProgress(const GlobalOptions& global);

void addRenderCommand(CLI::App& program, const GlobalOptions& global);
void addViewCommand(CLI::App& program, const GlobalOptions& global);
void addPlanCommand(CLI::App& program, const GlobalOptions& global);
void addInfoCommand(CLI::App& program, const GlobalOptions& global);
void addPyramidCommand(CLI::App& program, const GlobalOptions& global);
void addCompareCommand(CLI::App& program, const GlobalOptions& global);
void addBenchCommand(CLI::App& program, const GlobalOptions& global);
void addCacheCommand(CLI::App& program);
void addCaptureCommand(CLI::App& program, const GlobalOptions& global);
void addMergeCommand(CLI::App& program, const GlobalOptions& global);

}  // namespace defocus
