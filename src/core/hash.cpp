// Compiles XXH3 (Collet) into this file; inlined, it hashes long inputs faster than the shared library does.
#define XXH_INLINE_ALL
#include "core/hash.h"

#include <xxhash.h>

#include <bit>

namespace defocus::engine {

std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed) {
    return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

std::uint32_t murmurHash3(std::string_view text) {
    const auto mixed = [](std::uint32_t block) { return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u; };
    const auto byteAt = [&](std::size_t i) { return std::uint32_t{static_cast<unsigned char>(text[i])}; };
    std::uint32_t hash = 0;
    const std::size_t whole = text.size() / 4 * 4;
    for (std::size_t i = 0; i < whole; i += 4) {
        hash ^= mixed(byteAt(i) | byteAt(i + 1) << 8 | byteAt(i + 2) << 16 | byteAt(i + 3) << 24);
        hash = std::rotl(hash, 13) * 5 + 0xe6546b64u;
    }
    std::uint32_t rest = 0;
    for (std::size_t i = text.size(); i > whole; --i) rest = rest << 8 | byteAt(i - 1);
    hash ^= mixed(rest);
    return fmix32(hash ^ static_cast<std::uint32_t>(text.size()));
}

}  // namespace defocus::engine
