#pragma once
// Formats the line of a progress bar, for a terminal of any width.

#include <optional>
#include <string>
#include <string_view>

namespace defocus::engine {

// Returns "samples [####----]  42 %, 12 s left" in fewer than `columns` columns, so that no terminal breaks the line.
// If space is short, it leaves out the bar first, then the rest of the stage's name, then the time, then the name.
// `share`: 0 … 1. `left`: seconds; none: unknown.
std::string progressLine(std::string_view stage, double share, std::optional<double> left, int columns);

// Estimates the remaining time of work. Stages with the same first word, such as the frames of a film, count as one
// work.
class TimeLeft {
public:
    // Returns the seconds until `share` is 1, at the average pace so far. None while less than one second or one
    // hundredth of the work has passed. `seconds`: time since any fixed moment.
    std::optional<double> after(std::string_view stage, double share, double seconds);

private:
    std::string kind_;
    double begin_ = 0;
    double firstShare_ = 0;
    double lastShare_ = 0;
};

}  // namespace defocus::engine
