#pragma once
// Sub-commands of defocus bench that have files of their own.

#include "app/command.h"

namespace defocus {

void addConvergenceCommand(CLI::App& bench, const GlobalOptions& global);
void addBenchDiffCommand(CLI::App& bench);
void addPoppingCommand(CLI::App& bench, const GlobalOptions& global);
void addScalingCommand(CLI::App& bench, const GlobalOptions& global);
void addStabilityCommand(CLI::App& bench, const GlobalOptions& global);

}  // namespace defocus
