#pragma once
// Scrambles the Sobol' points of lens_rays.h and packet_samples.h. All pixels share the Sobol' points. Each stream of
// points is Owen-scrambled with its own seeds, in a few 32-bit integer operations. There is one stream per pixel, or
// one for all pixels.
//
//   Sobol' 1967; Kollig and Keller 2002, Efficient Multidimensional Sampling; Laine and Karras 2011, Stratified
//   Sampling for Stochastic Transparency; Burley 2020, Practical Hash-based Owen Scrambling.

#include <cstdint>

#include "embree/lens_rays.h"
#include "embree/ray_packet.h"

namespace defocus::engine {

// A two-dimensional point; each coordinate is a 32-bit fraction with its bits in reverse order.
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

// Owen scrambling: flips each bit of a fraction depending on a hash of its more significant bits (Laine and Karras
// 2011). Multiplication propagates bits upwards only, so `reversed` has the fraction's bits in reverse order. Returns
// the scrambled fraction with its bits in normal order.
DEFOCUS_ALWAYS_INLINE std::uint32_t owenScrambled(std::uint32_t reversed, std::uint32_t seed) {
    std::uint32_t x = reversed + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reversedBits(x);
}

// Returns point `index` of the dimension pair `pair` before it is scrambled. The points can be taken in 16 orders.
// Stream s, of one pixel, takes them in order s % 16, so the 16 pixels of a packet have different orders and
// uncorrelated errors.
ReversedPoint unscrambledPoint(std::uint32_t index, std::uint32_t order, SamplePair pair, std::uint32_t seed);
inline constexpr std::uint32_t orderCount = packetSize;

// Returns the seeds with which a stream scrambles the two dimensions of `pair`.
ReversedPoint scrambleSeeds(std::uint32_t stream, SamplePair pair, std::uint32_t seed);

}  // namespace defocus::engine
