// Progress on stderr: a bar that is redrawn in place, or a line now and then where stderr is a file or a pipe.

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "cli/command.h"
#include "core/message.h"

namespace defocus {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto firstShown = 1s;  // shorter work passes unseen
constexpr auto redraw = 100ms;
constexpr auto plainLines = 5s;

class ProgressLine {
public:
    ProgressLine() : terminal_(isatty(STDERR_FILENO) == 1) {}
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine() { erase(); }

    void show(std::string_view stage, std::uint64_t done, std::uint64_t total) {
        const Clock::time_point now = Clock::now();
        const bool ends = !terminal_ && stage == shown_ && done == total;  // what was said to be going on is done
        if (now < next_ && !ends) return;
        shown_ = stage;
        next_ = now + (terminal_ ? Clock::duration(redraw) : Clock::duration(plainLines));
        const double share = total > 0 ? std::min(1.0, static_cast<double>(done) / static_cast<double>(total)) : 0;
        if (terminal_)
            drawBar(stage, share);
        else
            printMessage("{}: {:.0f} %\n", stage, 100 * share);
    }

private:
    void drawBar(std::string_view stage, double share) {
        winsize window{};
        const bool sized = ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0;
        const int columns = sized ? window.ws_col : 80;
        const int width = std::clamp(columns - static_cast<int>(stage.size()) - 12, 0, 40);
        const int filled = static_cast<int>(share * width);
        const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                                std::string(static_cast<std::size_t>(width - filled), '-');
        printMessage("\r\x1b[K{} [{}] {:3.0f} %", stage, bar, 100 * share);
        drawn_ = true;
    }

    // What comes next, a summary or an error, begins on a clean line.
    void erase() {
        if (!drawn_) return;
        writeMessage("\r\x1b[K");
    }

    bool terminal_;
    bool drawn_ = false;
    std::string shown_;  // the stage that was shown last
    Clock::time_point next_ = Clock::now() + firstShown;
};

}  // namespace

Progress terminalProgress(const GlobalOptions& global) {
    if (global.quiet) return {};
    return [line = std::make_shared<ProgressLine>()](std::string_view stage, std::uint64_t done, std::uint64_t total) {
        line->show(stage, done, total);
    };
}

}  // namespace defocus
