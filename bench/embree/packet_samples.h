#pragma once
// Scrambled lens points for the pixels of a packet, in single precision: the packet versions of scrambledPoint and
// aperturePoint (lens_rays.h).

#include <array>
#include <cstdint>

#include "embree/ray_packet.h"
#include "embree/sample_scramble.h"

namespace defocus::engine {

// One ReversedPoint per lane.
struct ReversedLanes {
    Lanes<std::uint32_t> x, y;
};

// Returns unscrambledPoint in all orders; the result is the same for every packet.
ReversedLanes unscrambledPoints(std::uint32_t index, SamplePair pair, std::uint32_t seed);

// Returns scrambleSeeds of 16 streams from firstStream (a multiple of 16); the result is the same for every sample.
ReversedLanes packetSeeds(std::uint32_t firstStream, SamplePair pair, std::uint32_t seed);

// Returns the scrambled points in [0, 1)².
void scramblePoints(const ReversedLanes& points, const ReversedLanes& seeds, FloatLanes& x, FloatLanes& y);

// Precomputed data of aperturePoint for packets.
struct ApertureMap {
    explicit ApertureMap(const Lens& lens);

    static constexpr int maxBlades = 64;
    int bladeCount = 0;  // 0: a disk
    float scaleX = 1;    // anamorphic
    float scaleY = 1;
    std::array<float, maxBlades + 1> cornerX{};  // polygon corners; the first is repeated at the end
    std::array<float, maxBlades + 1> cornerY{};
};

// Maps (r, s) ∈ [0, 1)² to the aperture, in place.
void mapToAperture(const ApertureMap& map, FloatLanes& x, FloatLanes& y);

}  // namespace defocus::engine
