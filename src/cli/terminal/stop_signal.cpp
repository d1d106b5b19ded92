#include "cli/terminal/stop_signal.h"

#include <csignal>

namespace defocus::engine {

namespace {

volatile std::sig_atomic_t asked = 0;

}  // namespace

void stopWhenAsked() {
    struct sigaction action {};
    action.sa_handler = [](int) { asked = 1; };
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool stopAsked() {
    return asked != 0;
}

}  // namespace defocus::engine
