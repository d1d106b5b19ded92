// Compiles XXH3 (Collet) into this file, which is faster for long inputs than linking the shared library.
#define XXH_INLINE_ALL
#include "core/hash.h"

#include <xxhash.h>

namespace defocus::engine {

std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed) {
    return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

}  // namespace defocus::engine
