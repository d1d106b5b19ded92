#pragma once
// Integer operations for the scrambled points of lens_rays.h and packet_samples.h. Many streams share a Sobol' point,
// and each stream has its own Owen scramble of a few 32-bit operations.
//
//   Sobol' 1967; Kollig and Keller 2002, Efficient Multidimensional Sampling; Laine and Karras 2011, Stratified
//   Sampling for Stochastic Transparency; Burley 2020, Practical Hash-based Owen Scrambling.

#include <cstdint>

#include "embree/lens_rays.h"
#include "embree/ray_packet.h"

namespace defocus::engine {

// A two-dimensional point of 32-bit fractions with their bits in reverse order.
struct ReversedPoint {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};

DEFOCUS_ALWAYS_INLINE std::uint32_t reversedBits(std::uint32_t x) {
    x = ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    x = ((x & 0x00ff00ffu) << 8) | ((x >> 8) & 0x00ff00ffu);
    return (x << 16) | (x >> 16);
}

// Owen scrambling: flips each bit of a fraction by a hash of the more significant bits (Laine and Karras 2011). Their
// permutation propagates bits upwards only, so it takes the reversed bits. Returns the fraction.
DEFOCUS_ALWAYS_INLINE std::uint32_t owenScrambled(std::uint32_t reversed, std::uint32_t seed) {
    std::uint32_t x = reversed + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reversedBits(x);
}

// Returns point `index` of a pair's sequence before scrambling, in one of 16 orders. Stream s has order s % 16, so the
// pixels of a packet have different orders, whose errors differ. The points are computed once per sample for all
// packets.
ReversedPoint unscrambledPoint(std::uint32_t index, std::uint32_t order, SamplePair pair, std::uint32_t seed);
inline constexpr std::uint32_t orderCount = packetSize;

// Returns a stream's scrambling seeds for the two dimensions of a pair.
ReversedPoint scrambleSeeds(std::uint32_t stream, SamplePair pair, std::uint32_t seed);

}  // namespace defocus::engine
