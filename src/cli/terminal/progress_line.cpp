#include "cli/terminal/progress_line.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/number_text.h"

namespace defocus::engine {

namespace {

constexpr std::size_t widestBar = 40;
constexpr std::size_t narrowestBar = 8;

std::string firstWord(std::string_view text) {
    return std::string(text.substr(0, text.find_first_of(" ,")));
}

std::string bar(double share, std::size_t width) {
    const auto filled = static_cast<std::size_t>(share * static_cast<double>(width));
    return fmt::format("[{:#<{}}{:-<{}}]", "", filled, "", width - filled);
}

}  // namespace

std::string progressLine(std::string_view stage, double share, std::optional<double> left, int columns) {
    const std::size_t room = static_cast<std::size_t>(std::max(columns, 2)) - 1;  // a full line would wrap
    const std::string percent = fmt::format("{:.0f} %", 100 * share);
    const std::string time = left ? fmt::format(", {} left", durationText(*left)) : std::string();

    // The bar fills the columns that the text leaves free. Space for the longest time text is reserved, so that the
    // bar's length stays constant during a stage.
    const std::size_t words = stage.size() + 1 + 3 + std::string_view("100 %, 59:59 min left").size();
    if (room >= words + narrowestBar)
        return fmt::format("{} {} {:>5}{}", stage, bar(share, std::min(room - words, widestBar)), percent, time);
    for (const std::string& shorter :
         {fmt::format("{} {}{}", stage, percent, time), fmt::format("{} {}{}", firstWord(stage), percent, time),
          fmt::format("{} {}", firstWord(stage), percent), percent})
        if (shorter.size() <= room) return shorter;
    return {};
}

std::optional<double> TimeLeft::after(std::string_view stage, double share, double seconds) {
    if (const std::string kind = firstWord(stage); kind != kind_ || share < lastShare_) {
        kind_ = kind;
        begin_ = seconds;
        firstShare_ = share;
    }
    lastShare_ = share;
    const double done = share - firstShare_;
    const double taken = seconds - begin_;
    if (done < 0.01 || taken < 1) return {};
    return taken * (1 - share) / done;
}

}  // namespace defocus::engine
