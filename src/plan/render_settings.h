#pragma once
// Settings of a FramePlan with a fixed number of samples.

#include <optional>
#include <vector>

#include "defocus/focus.h"
#include "defocus/layers.h"
#include "defocus/settings.h"
#include "lod/pyramid/level_selection.h"

namespace defocus::engine {

inline constexpr std::uint32_t blockSamples = 64;  // lens samples per block; the frame's sum is the sum of its blocks

// Reasons why a simplified level looks like the full mesh: blur, and a small size in the image. Normal rendering
// selects levels by both; benchmarks can isolate one.
enum class LodCause {
    blurAndSize,
    size,  // levels depend only on the projected size, as with a pinhole
    blur,  // levels depend only on the blur, as if pixels were infinitely small
};

struct RenderSettings {
    std::uint32_t sampleCount = 64;  // lens samples, 1 … maxSamples
    // Number of subpixel positions at which each lens sample draws the scene: 1, or 4 in a 2 × 2 grid. The layer
    // textures have one texel per position.
    std::uint32_t positions = 1;
    Sequence sequence = Sequence::sobol;
    std::uint32_t seed = 0;  // selects one of many sets of sample points
    // Index of the first sample in the sequence. Reference images use a later part of the sequence.
    std::uint32_t firstSample = 0;
    LodMode lod = LodMode::fractional;
    LodMetric metric = LodMetric::automatic;
    LodCause lodCause = LodCause::blurAndSize;
    LodCoc lodCoc = LodCoc::smallest;
    LevelVertices levelVertices = LevelVertices::fitted;
    GivenThresholds thresholds = {};
    Shadows shadows = Shadows::automatic;
    bool multipleScattering = false;  // compensates for the energy that rough specular reflection loses
    double cocTolerance = 0.5;        // max error in px of the CoC interpolated inside a triangle, > 0
    // Disables culling, and draws with the lens instead of a pinhole even if nothing is visibly blurred.
    bool keepAll = false;
    // Range of focus distances to which the image can be refocused after rendering. Each object's levels suit the
    // smallest blur over this range, and the lens samples are kept even if nothing is blurred at the frame's own focus
    // distance. Needs a lens whose circle of confusion at depth w is C(w) = a + b·w (circle_of_confusion.h).
    std::optional<FocusRange> refocus = {};
    std::vector<Layer> layers = {};  // data layers, such as depth and normals, to accumulate beside the image
};

// Returns the number of positions in a pixel along each axis: 1 or 2.
int positionsPerAxis(const RenderSettings& settings);

// Returns the number of subpixel positions at which the scene is drawn, summed over all samples. This number determines
// the antialiasing of edges in focus.
std::uint32_t positionCount(const RenderSettings& settings);

// Multiplies the thresholds by `factor`; unset thresholds first get the defaults for frames of `sampleCount` samples.
void fixThresholds(RenderSettings& settings, std::uint32_t sampleCount, double factor = 1);

}  // namespace defocus::engine
