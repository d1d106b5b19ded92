#pragma once
// Formats numbers and durations for tables.

#include <cstdint>
#include <string>

namespace defocus::engine {

// Formats with thousands separators: "1,800,000".
std::string grouped(std::uint64_t number);

// Formats a duration: "42 s", "1:05 min", "2:30 h".
std::string durationText(double seconds);

}  // namespace defocus::engine
