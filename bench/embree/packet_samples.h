#pragma once
// Computes scrambled points on the lens and in the pixel for all pixels of a packet, in single precision. Vectorised
// versions of scrambledPoint and aperturePoint (lens_rays.h).

#include <array>
#include <cstdint>

#include "embree/ray_packet.h"
#include "embree/sample_scramble.h"

namespace defocus::engine {

// Points with reversed bits (ReversedPoint, sample_scramble.h), one for each of a packet's 16 lanes.
struct ReversedLanes {
    Lanes<std::uint32_t> x, y;
};

// Returns unscrambledPoint (sample_scramble.h) for all 16 lanes; lane i uses order i of the points. The result is the
// same for all packets.
ReversedLanes unscrambledPoints(std::uint32_t index, SamplePair pair, std::uint32_t seed);

// Returns scrambleSeeds (sample_scramble.h) for a packet's 16 pixels. Pixel i uses the stream (index of its scramble)
// firstStream + i. firstStream is a multiple of 16. The result is the same for all samples.
ReversedLanes packetSeeds(std::uint32_t firstStream, SamplePair pair, std::uint32_t seed);

// Writes the scrambled points, in [0, 1)², to `x` and `y`.
void scramblePoints(const ReversedLanes& points, const ReversedLanes& seeds, FloatLanes& x, FloatLanes& y);

// Data of the aperture that mapToAperture needs, computed once per lens.
struct ApertureMap {
    explicit ApertureMap(const Lens& lens);

    static constexpr int maxBlades = 64;
    int bladeCount = 0;  // number of blades; 0: round aperture
    float scaleX = 1;    // horizontal factor of the anamorphic scaling
    float scaleY = 1;
    std::array<float, maxBlades + 1> cornerX{};  // corners of the polygon; the first is repeated at the end
    std::array<float, maxBlades + 1> cornerY{};
};

// Maps points in [0, 1)² to the aperture, in place; see aperturePoint.
void mapToAperture(const ApertureMap& map, FloatLanes& x, FloatLanes& y);

}  // namespace defocus::engine
