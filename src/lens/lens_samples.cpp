#include "lens/lens_samples.h"

#include <algorithm>

namespace defocus {

namespace {

// Rounded to a float that is still below 1.
float belowOne(double value) {
    return std::min(static_cast<float>(value), 0x1.fffffep-1f);
}

}  // namespace

LensSample lensSample(const Aperture& aperture, Sequence sequence, std::uint64_t index, std::uint32_t seed) {
    const SequencePoint point = sequencePoint(sequence, index, seed);
    const glm::vec2 pixel(belowOne(point.pixel.x), belowOne(point.pixel.y));
    return {glm::vec2(apertureSample(aperture, point.lens)), pixel - 0.5f, belowOne(point.time), belowOne(point.band)};
}

std::vector<LensSample> lensSamples(const Lens& lens, Sequence sequence, std::uint64_t first, std::uint32_t count,
                                    std::uint32_t seed) {
    const Aperture aperture = makeAperture(lens);
    std::vector<LensSample> samples(count);
    for (std::uint32_t i = 0; i < count; ++i) samples[i] = lensSample(aperture, sequence, first + i, seed);
    return samples;
}

}  // namespace defocus
