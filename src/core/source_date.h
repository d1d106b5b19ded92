#pragma once
// Reads SOURCE_DATE_EPOCH, the date that reproducible files store:
// https://reproducible-builds.org/specs/source-date-epoch/

#include <ctime>
#include <optional>
#include <string>

namespace defocus::engine {

// Returns the value of the environment variable SOURCE_DATE_EPOCH, in seconds since 1970. If it is set, files store
// this date instead of the current date, and omit render times. Returns nullopt if the variable is unset or is not a
// number from 0 to 253402300799 (the end of the year 9999).
std::optional<std::time_t> sourceDate();

// Throws Error if SOURCE_DATE_EPOCH is set, but sourceDate() would return nullopt.
void checkSourceDate();

// Formats a time in UTC; `format` is a format string of strftime.
std::string utcText(std::time_t time, const char* format);

}  // namespace defocus::engine
