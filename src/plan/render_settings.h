#pragma once
// The settings that a plan depends on, with a number of samples that is known.

#include "defocus/settings.h"
#include "lod/pyramid/level_selection.h"

namespace defocus::engine {

// What may hide that a level is coarse. Benches isolate one cause; images need both.
enum class LodCause {
    blurAndSize,
    size,  // only the object's projected size, as with a pinhole
    blur,  // only the lens's blur, as with infinitely many pixels
};

struct RenderSettings {
    std::uint32_t sampleCount = 64;  // lens samples, 1 … maxSamples
    Sequence sequence = Sequence::sobol;
    std::uint32_t seed = 0;         // selects another set of sample points
    std::uint32_t firstSample = 0;  // offset into the sequence; references have their own
    LodMode lod = LodMode::fractional;
    LodMetric metric = LodMetric::automatic;
    LodCause lodCause = LodCause::blurAndSize;
    LodCoc lodCoc = LodCoc::smallest;
    LevelVertices levelVertices = LevelVertices::fitted;
    GivenThresholds thresholds = {};
    Shadows shadows = Shadows::automatic;
    double cocTolerance = 0.5;  // px by which C may differ from its interpolation inside a triangle, > 0
    bool keepAll = false;       // leave nothing out: the image must be the same
};

// Fixes the thresholds at `factor` times those that frames of `sampleCount` samples have.
void fixThresholds(RenderSettings& settings, std::uint32_t sampleCount, double factor = 1);

}  // namespace defocus::engine
