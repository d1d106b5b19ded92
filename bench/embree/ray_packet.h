#pragma once
// Defines packets of rays for 4 × 4 neighbouring pixels. Each quantity is an array of 16 lanes, so that compilers
// vectorise loops over the lanes. Embree accepts packets of 16 rays on every machine and splits them if its vectors are
// narrower.

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>

// Also compiles the function for AVX2; that version is selected at load time if the machine has AVX2. Called functions
// profit only if they are inlined. Disabled with AddressSanitizer, because the loader selects the version before the
// sanitizer's runtime is loaded.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define DEFOCUS_VECTOR_CLONES __attribute__((target_clones("arch=haswell", "default")))
#else
#define DEFOCUS_VECTOR_CLONES
#endif
#define DEFOCUS_ALWAYS_INLINE __attribute__((always_inline)) inline

namespace defocus::engine {

inline constexpr int packetSide = 4;  // width and height of a packet, px
inline constexpr int packetSize = packetSide * packetSide;

// One value per pixel of a packet: lane i is the pixel in column i % 4 (from the left) and row i / 4 (from the top).
template <typename Value>
struct alignas(64) Lanes {
    std::array<Value, packetSize> values{};

    Value& operator[](int lane) { return values[static_cast<std::size_t>(lane)]; }
    const Value& operator[](int lane) const { return values[static_cast<std::size_t>(lane)]; }
};

using FloatLanes = Lanes<float>;
using LaneMask = Lanes<int>;  // −1 for lanes in use, 0 for unused lanes

// Sample points of all lanes: in the pixel ([0, 1)² px, right and down) and on the lens (unit disk).
struct PacketPoints {
    FloatLanes pixelX, pixelY;
    FloatLanes lensX, lensY;
};

// Linear RGBA of all lanes, premultiplied.
struct PacketColors {
    FloatLanes red, green, blue, alpha;
};

}  // namespace defocus::engine
