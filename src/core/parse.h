#pragma once
// Parses text into values. Invalid text throws Error with a one-line message such as "'0' is not an integer from 1 to
// 65536".

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace defocus::engine {

struct Range {
    double min = 0;
    double max = 0;
    bool aboveMin = false;  // true: `min` itself is excluded
};

// Returns the number that the complete text represents; nullopt for other text and numbers outside the type's range.
template <typename Number>
std::optional<Number> parsedNumber(std::string_view text) {
    Number number{};
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

// Parses the complete text as a finite number in `range`. Throws Error, with the range in its message, for other text.
double parseNumber(const std::string& text, const Range& range);
std::uint64_t parseInteger(const std::string& text, std::uint64_t min, std::uint64_t max);
// Parses seconds as a decimal (0.02) or a fraction as in photography (1/48).
double parseSeconds(const std::string& text);
// Parses exactly `count` finite numbers in `range`, separated by commas.
std::vector<double> parseNumbers(const std::string& text, std::size_t count, const Range& range);
// Returns the index of `text` in `choices`. Throws Error, with all choices in its message, if `text` is not a choice.
std::size_t parseChoice(const std::string& text, const std::vector<std::string>& choices);

// Part `index` (0 … count − 1) of `count` equal parts of a task.
struct Share {
    int index = 0;
    int count = 1;
};

// Parses "index/count", e.g. "1/4". Throws Error unless both are integers with 0 ≤ index < count ≤ maxCount. The
// message calls a part `noun`, such as "tile".
Share parseShare(std::string_view text, std::string_view noun, int maxCount);

// Splits the text at each separator. Parts may be empty, and empty text gives one empty part.
std::vector<std::string> splitAt(std::string_view text, char separator);

}  // namespace defocus::engine
