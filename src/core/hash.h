#pragma once
// 64-bit FNV-1a (Fowler, Noll, Vo), eight bytes a step for bulk data; for cache keys and settings, not for security.

#include <cstddef>
#include <cstdint>
#include <span>

namespace defocus {

inline constexpr std::uint64_t hashSeed = 0xcbf29ce484222325ull;

// Hash of `bytes`, continued from `seed` so that several pieces can be chained.
std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed = hashSeed);

}  // namespace defocus
