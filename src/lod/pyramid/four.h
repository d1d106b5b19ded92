#pragma once
// Four numbers that GCC and Clang compute with at once.

#include <cstdint>
#include <cstring>

namespace defocus::engine {

using Four = float __attribute__((vector_size(16)));
using FourWords = std::uint32_t __attribute__((vector_size(16)));

// Reads and writes four numbers that lie one after the other.
template <typename Numbers, typename Value>
Numbers loaded(const Value* from) {
    Numbers numbers;
    std::memcpy(&numbers, from, sizeof(numbers));
    return numbers;
}
template <typename Numbers, typename Value>
void store(Value* to, const Numbers& numbers) {
    std::memcpy(to, &numbers, sizeof(numbers));
}

}  // namespace defocus::engine
