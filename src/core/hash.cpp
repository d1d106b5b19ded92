// XXH3 (Collet) is compiled in rather than linked: it is faster than the mixing that it replaced, for short keys and
// long data alike, and than its own shared library for long data.
#define XXH_INLINE_ALL
#include "core/hash.h"

#include <xxhash.h>

namespace defocus::engine {

std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed) {
    return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

}  // namespace defocus::engine
