#pragma once
// Numbers as the tables of the commands show them.

#include <cstdint>
#include <string>

namespace defocus::engine {

// "1,800,000"
std::string grouped(std::uint64_t number);

// "42 s", "1:05 min", "2:30 h"
std::string durationText(double seconds);

}  // namespace defocus::engine
