#include "embree/packet_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace defocus::engine {

namespace {

// Returns sin(2πt) for |t| ≤ 1/4, from a Taylor series; the first omitted term is below 6e-8.
DEFOCUS_ALWAYS_INLINE float sineOfTurn(float t) {
    const float x = 2 * std::numbers::pi_v<float> * t;
    const float square = x * x;
    float sum = 1 - square / 110;
    sum = 1 - square / 72 * sum;
    sum = 1 - square / 42 * sum;
    sum = 1 - square / 20 * sum;
    sum = 1 - square / 6 * sum;
    return x * sum;
}

DEFOCUS_VECTOR_CLONES void mapToDisk(const ApertureMap& map, FloatLanes& x, FloatLanes& y) {
    for (int i = 0; i < packetSize; ++i) {
        const float radius = std::sqrt(x[i]);
        const float turn = y[i] - 0.5f;  // half a turn is subtracted, so both coordinates get the opposite sign below
        const float folded = 0.25f - std::abs(turn);
        const float sine = sineOfTurn(std::copysign(0.25f - std::abs(folded), turn));
        const float cosine = sineOfTurn(folded);
        x[i] = -map.scaleX * radius * cosine;
        y[i] = -map.scaleY * radius * sine;
    }
}

DEFOCUS_VECTOR_CLONES void mapToPolygon(const ApertureMap& __restrict map, FloatLanes& __restrict x,
                                        FloatLanes& __restrict y) {
    const auto blades = static_cast<float>(map.bladeCount);
    const int last = map.bladeCount - 1;
    const float* cornerX = map.cornerX.data();
    const float* cornerY = map.cornerY.data();
    for (int i = 0; i < packetSize; ++i) {
        const float radius = std::sqrt(x[i]);
        const float turn = y[i] * blades;
        const int truncated = static_cast<int>(turn);
        const int blade = truncated < last ? truncated : last;
        const float along = turn - static_cast<float>(blade);
        x[i] = map.scaleX * radius * (cornerX[blade] + along * (cornerX[blade + 1] - cornerX[blade]));
        y[i] = map.scaleY * radius * (cornerY[blade] + along * (cornerY[blade + 1] - cornerY[blade]));
    }
}

}  // namespace

ReversedLanes unscrambledPoints(std::uint32_t index, SamplePair pair, std::uint32_t seed) {
    ReversedLanes points;
    for (int i = 0; i < packetSize; ++i) {
        const ReversedPoint point = unscrambledPoint(index, static_cast<std::uint32_t>(i), pair, seed);
        points.x[i] = point.x;
        points.y[i] = point.y;
    }
    return points;
}

ReversedLanes packetSeeds(std::uint32_t firstStream, SamplePair pair, std::uint32_t seed) {
    ReversedLanes seeds;
    for (int i = 0; i < packetSize; ++i) {
        const ReversedPoint own = scrambleSeeds(firstStream + static_cast<std::uint32_t>(i), pair, seed);
        seeds.x[i] = own.x;
        seeds.y[i] = own.y;
    }
    return seeds;
}

DEFOCUS_VECTOR_CLONES void scramblePoints(const ReversedLanes& points, const ReversedLanes& seeds, FloatLanes& x,
                                          FloatLanes& y) {
    for (int i = 0; i < packetSize; ++i)  // keep 24 of 32 bits, the precision of a float
        x[i] = 0x1p-24f * static_cast<float>(static_cast<std::int32_t>(owenScrambled(points.x[i], seeds.x[i]) >> 8));
    for (int i = 0; i < packetSize; ++i)
        y[i] = 0x1p-24f * static_cast<float>(static_cast<std::int32_t>(owenScrambled(points.y[i], seeds.y[i]) >> 8));
}

ApertureMap::ApertureMap(const Lens& lens)
    : scaleX(static_cast<float>(1 / std::max(lens.anamorphicRatio, 1.0))),
      scaleY(static_cast<float>(std::min(lens.anamorphicRatio, 1.0))) {
    if (lens.bladeCount < 3) return;
    bladeCount = std::min(lens.bladeCount, maxBlades);
    for (int i = 0; i <= bladeCount; ++i) {
        const double angle = lens.bladeRotation + 2 * std::numbers::pi * i / bladeCount;
        cornerX[static_cast<std::size_t>(i)] = static_cast<float>(std::cos(angle));
        cornerY[static_cast<std::size_t>(i)] = static_cast<float>(std::sin(angle));
    }
}

void mapToAperture(const ApertureMap& map, FloatLanes& x, FloatLanes& y) {
    if (map.bladeCount == 0)
        mapToDisk(map, x, y);
    else
        mapToPolygon(map, x, y);
}

}  // namespace defocus::engine
