#pragma once
// SIMD types: four values that GCC and Clang process in one instruction.

#include <cstdint>
#include <cstring>

namespace defocus::engine {

using Four = float __attribute__((vector_size(16)));
using FourWords = std::uint32_t __attribute__((vector_size(16)));

// loaded() reads four consecutive values; store() writes them.
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
