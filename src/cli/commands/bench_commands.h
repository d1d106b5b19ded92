#pragma once
// Sub-commands of defocus bench that have files of their own.

#include <filesystem>
#include <initializer_list>
#include <string>

#include "cli/command.h"
#include "eval/bench_subject.h"
#include "frame/report/program_facts.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"

namespace defocus::engine {

// Makes `folder` and checks that these files can be written there, before the long work; nothing for an empty path.
// Throws Error.
void makeOutputFolder(const std::filesystem::path& folder, std::initializer_list<const char*> files);

// Adds --allow-changed, which sets `allowed`.
void addAllowChanged(CLI::App& command, bool& allowed);

// Throws Error if results would go to `output` although the program was built from sources that differ from `commit`
// (see programCommit): no one could check such results out and repeat them. Does nothing if `output` is empty or
// `allowed` is set.
void refuseChangedSources(const std::filesystem::path& output, bool allowed,
                          const std::string& commit = programCommit());

// What a bench measures without options: in metres, as no figure may hang on a guess.
Request measuredRequest();

// This program, command and machine, the device of `context`, and what is measured: one frame, or what the bench makes
// by itself.
BenchSubject benchSubject(const GlContext& context, const GlobalOptions& global);
BenchSubject benchSubject(const GlContext& context, const GlobalOptions& global, const PreparedFrame& frame, int runs);

void addConvergenceCommand(CLI::App& bench, const GlobalOptions& global);
void addPoppingCommand(CLI::App& bench, const GlobalOptions& global);
void addScalingCommand(CLI::App& bench, const GlobalOptions& global);
void addPredictionCommand(CLI::App& bench, const GlobalOptions& global);
void addStabilityCommand(CLI::App& bench, const GlobalOptions& global);

}  // namespace defocus::engine
