#pragma once
// Computes non-cryptographic hashes. The hash values must not change: images, the fish school and files on disk depend
// on them.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace defocus::engine {

// Mixes the bits of an integer with the finaliser of MurmurHash3 (Appleby).
constexpr std::uint32_t fmix32(std::uint32_t bits) {
    bits = (bits ^ (bits >> 16)) * 0x85ebca6bu;
    bits = (bits ^ (bits >> 13)) * 0xc2b2ae35u;
    return bits ^ (bits >> 16);
}

// Mixes the bits of an integer with less bias than fmix32 (Wellons 2018, Prospecting for Hash Functions).
constexpr std::uint32_t lowbias32(std::uint32_t bits) {
    bits = (bits ^ (bits >> 16)) * 0x7feb352du;
    bits = (bits ^ (bits >> 15)) * 0x846ca68bu;
    return bits ^ (bits >> 16);
}

// Returns the 32-bit MurmurHash3 (x86, seed 0; Appleby) of a string.
std::uint32_t murmurHash3(std::string_view text);

inline constexpr std::uint64_t hashSeed = 0xcbf29ce484222325ull;

// Returns the XXH3 hash of `bytes`, for cache keys, checksums and hash tables. To hash several blocks, pass the hash of
// the previous block as `seed`.
std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed = hashSeed);

}  // namespace defocus::engine
