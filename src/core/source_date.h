#pragma once
// Reproducible files: https://reproducible-builds.org/specs/source-date-epoch/

#include <ctime>
#include <optional>
#include <string>

namespace defocus::engine {

// Returns the value of the environment variable SOURCE_DATE_EPOCH, in seconds since 1970. If it is set, files get this
// date instead of the current one, and no metadata about the run, such as its time. Returns nullopt if the variable is
// unset or not a number from 0 to 253402300799 (the year 9999).
std::optional<std::time_t> sourceDate();

// Throws Error if SOURCE_DATE_EPOCH is set to another text than such a number.
void checkSourceDate();

// Returns a time as text in UTC, in a format of strftime.
std::string utcText(std::time_t time, const char* format);

}  // namespace defocus::engine
