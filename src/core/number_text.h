#pragma once
// Numbers as the tables of the commands show them.

#include <cstdint>
#include <string>

namespace defocus {

// "1,800,000"
std::string grouped(std::uint64_t number);

}  // namespace defocus
