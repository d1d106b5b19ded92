#include "core/hash.h"

#include <cstring>

namespace defocus {

std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed) {
    constexpr std::uint64_t prime = 0x100000001b3ull;
    std::uint64_t hash = seed;
    while (bytes.size() >= sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data(), sizeof word);
        hash = (hash ^ word) * prime;
        hash ^= hash >> 32;  // FNV on whole words alone leaves the low bits blind to the high ones
        bytes = bytes.subspan(sizeof word);
    }
    for (const std::byte byte : bytes) hash = (hash ^ static_cast<std::uint64_t>(byte)) * prime;
    return hash;
}

}  // namespace defocus
