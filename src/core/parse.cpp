#include "core/parse.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ranges>

#include "core/error.h"
#include "core/suggestion.h"

namespace defocus::engine {

namespace {

// Describes the range in words: "a number above 0 and at most 100" or "a number from 0 to 100".
std::string inWords(const Range& range) {
    if (range.aboveMin) return fmt::format("a number above {:g} and at most {:g}", range.min, range.max);
    return fmt::format("a number from {:g} to {:g}", range.min, range.max);
}

// Removes a plus sign, which std::from_chars does not accept.
std::string_view withoutPlus(std::string_view text) {
    return text.substr(text.starts_with('+') && !text.starts_with("+-") ? 1 : 0);
}

bool inside(double number, const Range& range) {
    const bool low = range.aboveMin ? number > range.min : number >= range.min;
    return std::isfinite(number) && low && number <= range.max;
}

}  // namespace

std::vector<std::string> splitAt(std::string_view text, char separator) {
    if (text.empty()) return {""};  // std::views::split yields no part for empty text
    std::vector<std::string> parts;
    for (const auto part : std::views::split(text, separator)) parts.emplace_back(part.begin(), part.end());
    return parts;
}

double parseNumber(const std::string& text, const Range& range) {
    const std::optional<double> number = parsedNumber<double>(withoutPlus(text));
    if (!number || !inside(*number, range)) fail("'{}' is not {}", text, inWords(range));
    return *number;
}

double parseSeconds(const std::string& text) {
    constexpr double longest = 1e6;
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos) return parseNumber(text, {0, longest});
    return parseNumber(text.substr(0, slash), {0, longest}) / parseNumber(text.substr(slash + 1), {1e-6, longest});
}

std::uint64_t parseInteger(const std::string& text, std::uint64_t min, std::uint64_t max) {
    const std::optional<std::uint64_t> number = parsedNumber<std::uint64_t>(withoutPlus(text));
    if (!number || *number < min || *number > max) fail("'{}' is not an integer from {} to {}", text, min, max);
    return *number;
}

Share parseShare(std::string_view text, std::string_view noun, int maxCount) {
    const std::size_t slash = std::min(text.find('/'), text.size());
    const std::optional<int> index = parsedNumber<int>(withoutPlus(text.substr(0, slash)));
    const std::optional<int> count = parsedNumber<int>(withoutPlus(text.substr(std::min(slash + 1, text.size()))));
    if (!index || !count || *index < 0 || *index >= maxCount || *count < 1 || *count > maxCount)
        fail("'{0}' is not I/N, such as 0/4, where I is the {1} (0 to N-1) and N the number of {1}s", text, noun);
    if (*index >= *count)
        fail("'{}': with {} {}s, the {} must be from 0 to {} (in a Slurm job array: --array=0-{})", text, *count, noun,
             noun, *count - 1, *count - 1);
    return {*index, *count};
}

std::vector<double> parseNumbers(const std::string& text, std::size_t count, const Range& range) {
    std::vector<double> numbers;
    for (const std::string& part : splitAt(text, ',')) {
        const std::optional<double> number = parsedNumber<double>(withoutPlus(part));
        if (!number || !inside(*number, range)) break;
        numbers.push_back(*number);
    }
    if (numbers.size() != count || splitAt(text, ',').size() != count)
        fail("'{}' is not a list of {} numbers separated by commas, each {}", text, count, inWords(range));
    return numbers;
}

std::size_t parseChoice(const std::string& text, const std::vector<std::string>& choices) {
    for (std::size_t i = 0; i < choices.size(); ++i)
        if (choices[i] == text) return i;
    if (choices.size() == 1) fail("'{}' is not valid; the only choice is '{}'", text, choices.front());
    const std::string nearest = nearestWord(text, choices);
    fail("'{}' is not one of {}{}", text, fmt::join(choices, ", "),
         nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest));
}

}  // namespace defocus::engine
