#pragma once
// The scrambled points of a packet's pixels on the lens, as scrambledPoint and aperturePoint (lens_rays.h) have them
// one by one, in single precision.

#include <array>
#include <cstdint>

#include "embree/ray_packet.h"
#include "embree/sample_scramble.h"

namespace defocus::engine {

// A ReversedPoint a lane.
struct ReversedLanes {
    Lanes<std::uint32_t> x, y;
};

// unscrambledPoint in all orders: the same for every packet.
ReversedLanes unscrambledPoints(std::uint32_t index, SamplePair pair, std::uint32_t seed);

// scrambleSeeds of the streams firstStream (a multiple of 16) and on: the same for every sample.
ReversedLanes packetSeeds(std::uint32_t firstStream, SamplePair pair, std::uint32_t seed);

// Points in [0, 1)².
void scramblePoints(const ReversedLanes& points, const ReversedLanes& seeds, FloatLanes& x, FloatLanes& y);

// aperturePoint for packets: what of it is the same for all points.
struct ApertureMap {
    explicit ApertureMap(const Lens& lens);

    static constexpr int maxBlades = 64;
    int bladeCount = 0;  // 0: a disk
    float scaleX = 1;    // anamorphic
    float scaleY = 1;
    std::array<float, maxBlades + 1> cornerX{};  // of the polygon, the first one again at the end
    std::array<float, maxBlades + 1> cornerY{};
};

// (r, s) ∈ [0, 1)² → the aperture, in place.
void mapToAperture(const ApertureMap& map, FloatLanes& x, FloatLanes& y);

}  // namespace defocus::engine
