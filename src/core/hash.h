#pragma once
// A 64-bit hash for cache keys, checksums and tables, not for security: XXH3 of the xxHash library, whose values are
// fixed for good, so that what is stored on disk can be found again.

#include <cstddef>
#include <cstdint>
#include <span>

namespace defocus {

inline constexpr std::uint64_t hashSeed = 0xcbf29ce484222325ull;

// Hash of `bytes` and their number, continued from `seed` so that several pieces can be chained.
std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed = hashSeed);

}  // namespace defocus
