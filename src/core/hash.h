#pragma once
// A 64-bit hash for cache keys, checksums and tables, not for security: eight bytes a step, each mixed by itself before
// it is chained, so that equal changes in neighbouring words (a sign flipped here and there) don't cancel out.

#include <cstddef>
#include <cstdint>
#include <span>

namespace defocus {

inline constexpr std::uint64_t hashSeed = 0xcbf29ce484222325ull;

// Hash of `bytes` and their number, continued from `seed` so that several pieces can be chained. Whatever changes
// within one aligned group of eight bytes, and nowhere else, always changes the hash.
std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed = hashSeed);

}  // namespace defocus
