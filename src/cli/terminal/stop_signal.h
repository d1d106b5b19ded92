#pragma once
// Handles SIGINT (Ctrl-C) and SIGTERM (sent by Slurm before the end of a job). The first signal asks long work to stop
// after its current draw. A watchdog thread ends the process if it still runs 0.5 s later, even within a long draw. The
// next signal ends the process at once.

#include <functional>
#include <string>

namespace defocus::engine {

// Installs the signal handlers and starts the watchdog thread, which ends the process 0.5 s after the first signal.
void stopWhenAsked();
// Returns whether a signal has requested a stop.
bool stopAsked();
// Sets the line that is printed if the watchdog thread ends the process, such as "stopped: 3 of 9 rows are kept".
void setStopMessage(std::string message);
// Sets a function that the watchdog thread calls to save finished results before it ends the process. The function
// returns the line to print, instead of the line set by setStopMessage(). The function may run while the main thread is
// inside a draw.
void setStopAction(std::function<std::string()> save);
// Makes the calling thread, instead of the watchdog thread (the "second thread"), responsible for saving finished
// results and for ending the process. Doesn't return if the watchdog thread has begun to end the process.
void endWithoutSecondThread();

}  // namespace defocus::engine
