#pragma once
// Declares the sub-commands of `defocus bench` that have files of their own, and functions that they share.

#include <filesystem>
#include <initializer_list>
#include <string>

#include "cli/command.h"
#include "eval/bench_subject.h"
#include "frame/program_facts.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"

namespace defocus::engine {

// Destinations of the results of a `defocus bench` command.
struct BenchOutput {
    std::filesystem::path folder;  // folder of the results; empty: print the table only
    std::filesystem::path report;  // folder of results and report; empty: results go to `folder`, without a report
    bool allowChanged = false;     // true: accept a program built from uncommitted changes
};

// Adds the options --output, --report and --allow-changed. `results` names the result files in the help text of
// --output, such as "the result view.json". `hasReport`: whether to add --report; false for commands without plots.
void addBenchOutput(CLI::App& command, BenchOutput& output, const std::string& results, bool hasReport = true);

// Creates the folder of the results and returns its path; empty if no results are to be written. Throws Error in the
// same cases as refuseChangedSources() and makeOutputFolder().
std::filesystem::path openBenchOutput(const BenchOutput& output, std::initializer_list<const char*> files);

// Creates `folder` and checks that `files` can be written there, so that a long measurement doesn't fail at its end.
// Does nothing for an empty path. Throws Error if the folder or a file cannot be written.
void makeOutputFolder(const std::filesystem::path& folder, std::initializer_list<const char*> files);

// Adds the option --allow-changed. It sets `allowed` to true, so that a program built from uncommitted changes may
// write results.
void addAllowChanged(CLI::App& command, bool& allowed);

// Throws Error if a program built from uncommitted changes (see programCommit) would write results to `output`: such
// results could not be reproduced. Does nothing if `output` is empty or `allowed` is true.
void refuseChangedSources(const std::filesystem::path& output, bool allowed,
                          const std::string& commit = programCommit());

// Returns the default request of the `defocus bench` commands. The scene's unit is a metre, so that no result depends
// on a guessed unit.
Request measuredRequest();

// Describes what a `defocus bench` command measures: program, command, machine and the device of `context`. The second
// overload adds the scene, camera and lens of `frame`, and `runs`, the number of runs of each frame.
BenchSubject benchSubject(const GlContext& context, const GlobalOptions& global);
BenchSubject benchSubject(const GlContext& context, const GlobalOptions& global, const PreparedFrame& frame, int runs);

void addBenchViewCommand(CLI::App& bench, const GlobalOptions& global);
void addConvergenceCommand(CLI::App& bench, const GlobalOptions& global);
void addPoppingCommand(CLI::App& bench, const GlobalOptions& global);
void addScalingCommand(CLI::App& bench, const GlobalOptions& global);
void addPredictionCommand(CLI::App& bench, const GlobalOptions& global);
void addStabilityCommand(CLI::App& bench, const GlobalOptions& global);

}  // namespace defocus::engine
