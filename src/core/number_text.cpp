#include "core/number_text.h"

#include <fmt/format.h>

namespace defocus::engine {

std::string grouped(std::uint64_t number) {
    return fmt::to_string(fmt::group_digits(number));
}

std::string durationText(double seconds) {
    const auto whole = static_cast<long long>(seconds + 0.5);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
    return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

}  // namespace defocus::engine
