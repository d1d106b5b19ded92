#pragma once
// Handles SIGINT (Ctrl-C) and SIGTERM (sent by Slurm before the end of a job): lets long work stop after the current
// step.

namespace defocus::engine {

// Installs the handlers. The first signal only requests a stop; the next one ends the process.
void stopWhenAsked();
// Returns whether a signal has requested a stop.
bool stopAsked();

}  // namespace defocus::engine
