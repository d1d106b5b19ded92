#pragma once
// Formats a progress bar as one line for a terminal of any width.

#include <optional>
#include <string>
#include <string_view>

namespace defocus::engine {

// Returns a line such as "samples [####----]  42 %, 12 s left", shorter than `columns`, so that no terminal wraps it.
// If space is short, the function omits in this order: the bar, all words of the stage's name but the first, the time,
// the first word. `share`: finished fraction, 0 … 1. `left`: remaining seconds; nullopt: unknown.
std::string progressLine(std::string_view stage, double share, std::optional<double> left, int columns);

// Estimates the remaining time of a task. Stages with the same first word, such as the frames of a shot, count as one
// task.
class TimeLeft {
public:
    // Returns the remaining time in seconds, extrapolated from the average speed so far. Returns nullopt within the
    // first second or the first hundredth of the work. `share`: finished fraction. `seconds`: current time of any
    // monotonic clock.
    std::optional<double> after(std::string_view stage, double share, double seconds);

private:
    std::string kind_;
    double begin_ = 0;
    double firstShare_ = 0;
    double lastShare_ = 0;
};

}  // namespace defocus::engine
