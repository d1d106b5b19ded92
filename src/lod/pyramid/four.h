#pragma once
// Defines SIMD types with four values, which GCC and Clang process in one instruction.

#include <cstdint>
#include <cstring>

namespace defocus::engine {

using Four = float __attribute__((vector_size(16)));
using FourWords = std::uint32_t __attribute__((vector_size(16)));

// loaded() reads four consecutive values into a SIMD type; store() writes them to memory.
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
