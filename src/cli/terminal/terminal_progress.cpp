// Shows progress on stderr: a bar redrawn in place on a terminal, occasional lines in a file or pipe.

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "cli/command.h"
#include "cli/terminal/progress_line.h"
#include "core/message.h"
#include "core/number_text.h"

namespace defocus::engine {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto firstShown = 1s;  // shorter work shows no progress
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
        const double share = total > 0 ? std::min(1.0, static_cast<double>(done) / static_cast<double>(total)) : 0;
        const std::optional<double> left =
            timeLeft_.after(stage, share, std::chrono::duration<double>(now.time_since_epoch()).count());
        const bool ends = !terminal_ && stage == shown_ && done == total;  // the displayed stage is complete
        if (now < next_ && !ends) return;
        shown_ = stage;
        next_ = now + (terminal_ ? Clock::duration(redraw) : Clock::duration(plainLines));
        if (terminal_)
            drawBar(stage, share, left);
        else if (left && share < 1)
            printMessage("{}: {:.0f} %, {} left\n", stage, 100 * share, durationText(*left));
        else
            printMessage("{}: {:.0f} %\n", stage, 100 * share);
    }

private:
    void drawBar(std::string_view stage, double share, std::optional<double> left) {
        winsize window{};
        const bool sized = ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0;
        writeMessage("\r\x1b[K" + progressLine(stage, share, left, sized ? window.ws_col : 80));
        drawn_ = true;
    }

    // Erases the bar, so that the next message begins on an empty line.
    void erase() {
        if (!drawn_) return;
        writeMessage("\r\x1b[K");
    }

    bool terminal_;
    bool drawn_ = false;
    TimeLeft timeLeft_;
    std::string shown_;  // stage that was displayed last
    Clock::time_point next_ = Clock::now() + firstShown;
};

}  // namespace

Progress terminalProgress(const GlobalOptions& global) {
    if (global.quiet) return {};
    return [line = std::make_shared<ProgressLine>()](std::string_view stage, std::uint64_t done, std::uint64_t total) {
        line->show(stage, done, total);
    };
}

}  // namespace defocus::engine
