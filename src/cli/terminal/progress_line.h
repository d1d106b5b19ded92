#pragma once
// The line of a progress bar, for a terminal of any width.

#include <optional>
#include <string>
#include <string_view>

namespace defocus::engine {

// "samples [####----]  42 %, 12 s left" in fewer than `columns` columns, so that no terminal breaks the line. Where
// they are few, the bar goes first, then what follows the stage's name, then the time, then the name. `share` is from 0
// to 1, `left` in seconds; none: not known yet.
std::string progressLine(std::string_view stage, double share, std::optional<double> left, int columns);

// How long work of one kind will take. Stages whose first words are alike, such as the frames of a film, are one kind.
class TimeLeft {
public:
    // Seconds until `share` is 1, at the pace of the stage so far; none within its first second and first hundredth.
    // `seconds`: the time now, from any fixed moment on.
    std::optional<double> after(std::string_view stage, double share, double seconds);

private:
    std::string kind_;
    double begin_ = 0;
    double firstShare_ = 0;
    double lastShare_ = 0;
};

}  // namespace defocus::engine
