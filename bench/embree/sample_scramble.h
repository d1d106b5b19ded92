#pragma once
// The integers behind lens_rays.h's scrambled points and their packets: a Sobol' point that many streams share, and an
// Owen scramble of each stream's own, a few operations on 32 bits.
//
//   Sobol' 1967; Kollig and Keller 2002, Efficient Multidimensional Sampling; Laine and Karras 2011, Stratified
//   Sampling for Stochastic Transparency; Burley 2020, Practical Hash-based Owen Scrambling.

#include <cstdint>

#include "embree/lens_rays.h"
#include "embree/ray_packet.h"

namespace defocus::engine {

// A two-dimensional point as fractions of 32 bits, the bits in reverse order.
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

// Owen scrambling: each bit of a fraction is flipped by a hash of the bits above it (Laine and Karras 2011, whose
// permutation lets bits act upwards only, on the reversed bits). Takes reversed bits and returns the fraction.
DEFOCUS_ALWAYS_INLINE std::uint32_t owenScrambled(std::uint32_t reversed, std::uint32_t seed) {
    std::uint32_t x = reversed + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reversedBits(x);
}

// Point `index` of a pair's sequence before it is scrambled, in one of 16 orders. Stream s has order s % 16, so that a
// packet's pixels have one of each, made once a sample for all packets: what an order does badly, others do well.
ReversedPoint unscrambledPoint(std::uint32_t index, std::uint32_t order, SamplePair pair, std::uint32_t seed);
inline constexpr std::uint32_t orderCount = packetSize;

// What a stream scrambles the two dimensions of a pair with.
ReversedPoint scrambleSeeds(std::uint32_t stream, SamplePair pair, std::uint32_t seed);

}  // namespace defocus::engine
