#include "core/parse.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <ranges>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "core/suggestion.h"

namespace defocus::engine {

namespace {

// Describes the range in words: "a number above 0 and at most 100" or "a number from 0 to 100".
std::string inWords(const Range& range) {
    if (range.aboveMin) return fmt::format("a number above {:g} and at most {:g}", range.min, range.max);
    return fmt::format("a number from {:g} to {:g}", range.min, range.max);
}

template <typename Number>
std::optional<Number> wholeText(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    Number number{};
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
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
    const std::optional<double> number = wholeText<double>(text);
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
    const std::optional<std::uint64_t> number = wholeText<std::uint64_t>(text);
    if (!number || *number < min || *number > max) fail("'{}' is not an integer from {} to {}", text, min, max);
    return *number;
}

std::vector<double> parseNumbers(const std::string& text, std::size_t count, const Range& range) {
    std::vector<double> numbers;
    for (const std::string& part : splitAt(text, ',')) {
        const std::optional<double> number = wholeText<double>(part);
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
