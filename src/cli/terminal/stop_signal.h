#pragma once
// Handles SIGINT (Ctrl-C) and SIGTERM (sent by Slurm before the end of a job). The first signal asks long work to stop
// after its current draw; the next one ends the process at once.

#include <string>

namespace defocus::engine {

enum class StopWithin {
    aSecond,      // a second thread ends the process if it still runs after 0.5 s, even within a long draw
    currentDraw,  // the process ends by itself, after it has saved what is finished
};

// Installs the handlers.
void stopWhenAsked(StopWithin within = StopWithin::aSecond);
// Returns whether a signal has requested a stop.
bool stopAsked();
// Sets the line that is printed if the second thread ends the process, such as "stopped: 3 of 9 rows are kept".
void setStopMessage(std::string message);

}  // namespace defocus::engine
