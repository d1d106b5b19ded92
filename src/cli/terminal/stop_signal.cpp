#include "cli/terminal/stop_signal.h"

#include <semaphore.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "core/file.h"
#include "core/message.h"

namespace defocus::engine {

namespace {

constexpr auto patience = std::chrono::milliseconds(500);
constexpr int stopped = 1;  // exit code of a process that a signal stopped

volatile std::sig_atomic_t asked = 0;
sem_t wake;  // posted by the signal handler, in which sem_post is safe

// State that the main thread shares with the watchdog thread, which calls `save` and prints the returned line before it
// ends the process. Never destroyed, because the watchdog thread may outlive static objects.
struct End {
    std::mutex mutex;
    std::function<std::string()> save = [] { return std::string("stopped"); };
    bool byOther = false;  // true: the thread that called endWithoutSecondThread() ends the process
};

End& end() {
    static End& only = *new End;
    return only;
}

// Waits for a signal, then ends the process after 0.5 s. The main thread may still be inside a draw, so destructors
// cannot run.
void endWhenAsked() {
    while (sem_wait(&wake) != 0) {
    }
    std::this_thread::sleep_for(patience);
    const std::scoped_lock lock(end().mutex);
    if (end().byOther) return;
    removePendingFiles();
    std::string line;
    try {
        line = end().save();
    } catch (const std::exception& error) {
        line = error.what();
    }
    if (isatty(STDERR_FILENO) == 1) writeMessage("\r\x1b[K");  // erase the progress line
    printMessage("defocus: {}\n", line);
    ::_exit(stopped);
}

}  // namespace

void stopWhenAsked() {
    static std::once_flag once;
    std::call_once(once, [] {
        sem_init(&wake, 0, 0);
        std::thread(endWhenAsked).detach();
    });
    struct sigaction action {};
    action.sa_handler = [](int) {
        asked = 1;
        sem_post(&wake);
    };
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool stopAsked() {
    return asked != 0;
}

void setStopMessage(std::string message) {
    setStopAction([message = std::move(message)] { return message; });
}

void setStopAction(std::function<std::string()> save) {
    const std::scoped_lock lock(end().mutex);
    end().save = std::move(save);
}

void endWithoutSecondThread() {
    const std::scoped_lock lock(end().mutex);
    end().byOther = true;
}

}  // namespace defocus::engine
