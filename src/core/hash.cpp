// XXH3 (Collet) is compiled in rather than linked: for long data this is faster than its shared library.
#define XXH_INLINE_ALL
#include "core/hash.h"

#include <xxhash.h>

namespace defocus::engine {

std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed) {
    return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

}  // namespace defocus::engine
