#pragma once
// SIGINT (Ctrl-C) and SIGTERM (Slurm's, before the end of a job) end long work after the piece that is being drawn.

namespace defocus::engine {

// From now on the first of these signals only asks to stop; the next ends the process.
void stopWhenAsked();
bool stopAsked();

}  // namespace defocus::engine
