#pragma once
// The scrambled points of a packet's pixels on the lens, as scrambledPoint and aperturePoint (lens_rays.h) have them
// one by one, in single precision.

#include <array>
#include <cstdint>

#include "embree/ray_packet.h"
#include "embree/sample_scramble.h"

namespace defocus {

// Of 16 streams, for all samples.
struct PacketSeeds {
    Lanes<std::uint32_t> x, y;
};

PacketSeeds packetSeeds(const Lanes<std::uint32_t>& streams, SamplePair pair, std::uint32_t seed);

// Points in [0, 1)².
void scramblePoints(const ReversedPoint& point, const PacketSeeds& seeds, FloatLanes& x, FloatLanes& y);

// aperturePoint for packets: what of it is the same for all points.
struct ApertureMap {
    explicit ApertureMap(const Lens& lens);

    static constexpr int mostBlades = 64;
    int bladeCount = 0;  // 0: a disk
    float scaleX = 1;    // anamorphic
    float scaleY = 1;
    std::array<float, mostBlades + 1> cornerX{};  // of the polygon, the first one again at the end
    std::array<float, mostBlades + 1> cornerY{};
};

// (r, s) ∈ [0, 1)² → the aperture, in place.
void mapToAperture(const ApertureMap& map, FloatLanes& x, FloatLanes& y);

}  // namespace defocus
