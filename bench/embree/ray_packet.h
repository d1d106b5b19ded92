#pragma once
// Rays are made, traced and shaded in packets of 16 neighbouring pixels, 4 × 4, each quantity an array of 16 lanes, so
// that loops over the lanes become vector instructions. Embree takes packets of 16 on every machine; where its vectors
// are narrower it walks through them in parts.

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>

// Compiles a function for AVX2 too and takes that where the machine has it. Whatever it calls must be inlined, or it
// stays as it is. The sanitizers can't be loaded before the choice is made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define DEFOCUS_VECTOR_CLONES __attribute__((target_clones("arch=haswell", "default")))
#else
#define DEFOCUS_VECTOR_CLONES
#endif
#define DEFOCUS_ALWAYS_INLINE __attribute__((always_inline)) inline

namespace defocus::engine {

inline constexpr int packetSide = 4;  // px
inline constexpr int packetSize = packetSide * packetSide;

// Lane i is pixel (i % 4, i / 4) of the packet, right and down.
template <typename Value>
struct alignas(64) Lanes {
    std::array<Value, packetSize> values{};

    Value& operator[](int lane) { return values[static_cast<std::size_t>(lane)]; }
    const Value& operator[](int lane) const { return values[static_cast<std::size_t>(lane)]; }
};

using FloatLanes = Lanes<float>;
using LaneMask = Lanes<int>;  // −1: in use, 0: not

// Where a sample lies in each pixel ([0, 1)², px right and down) and on the lens (unit disk).
struct PacketPoints {
    FloatLanes pixelX, pixelY;
    FloatLanes lensX, lensY;
};

// Linear RGBA, premultiplied.
struct PacketColors {
    FloatLanes red, green, blue, alpha;
};

}  // namespace defocus::engine
