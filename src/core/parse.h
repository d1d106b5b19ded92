#pragma once
// Text to values, by one set of rules: a wrong value gives one clear line, "'0' is not an integer from 1 to 65536".

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace defocus::engine {

struct Range {
    double min = 0;
    double max = 0;
    bool aboveMin = false;  // `least` itself is not allowed
};

// The whole text as a finite number in `range`. Throws Error saying what is allowed.
double parseNumber(const std::string& text, const Range& range);
std::uint64_t parseInteger(const std::string& text, std::uint64_t min, std::uint64_t max);
// Seconds, as 0.02 or as photographers have them: 1/48.
double parseSeconds(const std::string& text);
// Exactly `count` finite numbers in `range`, parted by commas.
std::vector<double> parseNumbers(const std::string& text, std::size_t count, const Range& range);
// The place of `text` in `choices`. Throws Error listing them.
std::size_t parseChoice(const std::string& text, const std::vector<std::string>& choices);

// Returns what lies between the separators, one part more than there are of them; parts may be empty.
std::vector<std::string> splitAt(std::string_view text, char separator);

}  // namespace defocus::engine
