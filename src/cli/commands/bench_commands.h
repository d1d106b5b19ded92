#pragma once
// Sub-commands of `defocus bench` in files of their own.

#include <filesystem>
#include <initializer_list>
#include <string>

#include "cli/command.h"
#include "eval/bench_subject.h"
#include "frame/program_facts.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"

namespace defocus::engine {

// Creates `folder` and checks that these files can be written there, before the long work. Does nothing for an empty
// path. Throws Error.
void makeOutputFolder(const std::filesystem::path& folder, std::initializer_list<const char*> files);

// Adds the option --allow-changed, which sets `allowed`.
void addAllowChanged(CLI::App& command, bool& allowed);

// Throws Error if results would be written to `output` by a program built from changed sources (see programCommit),
// because nobody could repeat such results. Does nothing if `output` is empty or `allowed` is set.
void refuseChangedSources(const std::filesystem::path& output, bool allowed,
                          const std::string& commit = programCommit());

// Returns the default request of a bench. Its unit is the metre, so that no result depends on a guessed unit.
Request measuredRequest();

// Describes the subject of a bench: program, command, machine and the device of `context`; with `frame`, also its
// scene, camera and lens.
BenchSubject benchSubject(const GlContext& context, const GlobalOptions& global);
BenchSubject benchSubject(const GlContext& context, const GlobalOptions& global, const PreparedFrame& frame, int runs);

void addConvergenceCommand(CLI::App& bench, const GlobalOptions& global);
void addPoppingCommand(CLI::App& bench, const GlobalOptions& global);
void addScalingCommand(CLI::App& bench, const GlobalOptions& global);
void addPredictionCommand(CLI::App& bench, const GlobalOptions& global);
void addStabilityCommand(CLI::App& bench, const GlobalOptions& global);

}  // namespace defocus::engine
