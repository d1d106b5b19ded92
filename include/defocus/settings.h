#pragma once
// How an image is made of samples and levels of detail. docs/settings.md lists every setting with its range; the
// defaults are those of `defocus render`.

#include <cstdint>
#include <optional>

namespace defocus {

inline constexpr std::uint32_t mostSamples = 65'536;  // lens samples of a frame
inline constexpr std::uint32_t automaticSamples = 0;  // in place of a number: as many as the picture asks for
inline constexpr int mostPixels = 16'384;             // of an image's width and of its height

// Where the lens samples lie on the lens, in the pixel and in the exposure. All are infinite, with well spread
// prefixes.
enum class Sequence {
    halton,           // bases 2, 3 on the lens, 5, 7 in the pixel, as Jeong, Kim and Lee have it; 11 and 13 after them
    scrambledHalton,  // the same with its digits permuted at random, each by those before it
    sobol,            // six dimensions, Owen-scrambled: a net on the lens
    r2,               // additive recurrence by powers of the plastic number
};

// Coarser meshes for objects whose blur or size hides the difference (Jeong, Kim and Lee 2011).
enum class LodMode {
    fractional,  // samples split between ⌊λ⌋ and ⌊λ⌋ + 1
    continuous,  // the same, and the sample at the boundary is split over its pixels
    nearest,     // every sample draws round(λ)
    off,         // full detail
};

// What levels are chosen by.
enum class LodMetric {
    automatic,  // `size` where a blur or a size threshold is given, else `measured`
    size,       // target edge length in px, against the edges that the levels have
    error,      // target deviation in px
    halving,    // target edge length in px, as if each level had exactly half the triangles (Jeong, Kim and Lee 2011)
    measured,   // target error of the light that a blur leaves, as a share of how it varies there
    score,      // target edge length by blur alone, against the edges at the object's centre (Tzeng et al. 2012)
};

// What hides that a level is coarse. Benches ask for one alone; images need both.
enum class LodCause {
    blurAndSize,
    size,  // only that the object is small in the image, as if the lens were a pinhole
    blur,  // only the blur of the lens, as if the image had infinitely many pixels
};

// What coarser levels of a mesh are made of.
enum class LevelVertices {
    fitted,     // vertices with positions, normals, colours and texture coordinates that are fitted to full detail
    surviving,  // vertices of full detail with their own values, as published
    quarters,   // the same, but three levels alone, of 100, 75 and 50 % of the vertices (Tzeng et al. 2012)
};

// By size and by error the target is max(blur · c, size) px for a circle of confusion of c px. Measured levels err by
// at most light / edge, in standard deviations of the object's light within its blur, for edges of `edge` px. What isn't
// given follows the number of samples, so that long renders converge to full detail.
struct GivenThresholds {
    std::optional<double> blur = {};   // px a px of blur, ≥ 0
    std::optional<double> size = {};   // px, ≥ 0; not of LodMetric::score
    std::optional<double> light = {};  // px, ≥ 0; of LodMetric::measured alone, which has neither of the others
};

// Whether lights and surroundings cast shadows.
enum class Shadows {
    automatic,  // on where there is a ground to catch them (Request::ground)
    on,
    off,
};

struct RenderSettings {
    std::uint32_t sampleCount = 64;  // lens samples, 1 … mostSamples; of a request also automaticSamples
    Sequence sequence = Sequence::sobol;
    std::uint32_t seed = 0;         // picks another set of sample points
    std::uint32_t firstSample = 0;  // offset into the sequence (a reference takes its own)
    LodMode lod = LodMode::fractional;
    LodMetric metric = LodMetric::automatic;
    LodCause lodCause = LodCause::blurAndSize;
    bool lodCocAtCentre = false;  // c at the box's centre (the paper) instead of the smallest over the box
    LevelVertices levelVertices = LevelVertices::fitted;
    GivenThresholds thresholds = {};
    Shadows shadows = Shadows::automatic;
    double cocTolerance = 0.5;  // px by which C may differ from its interpolation inside a triangle, > 0
    bool keepAll = false;       // leave nothing out: the image must be the same
};

// When a frame has lens samples enough, where their number isn't chosen beforehand. With either of the first two,
// blocks of 64 samples are added until one of them holds; RenderSettings::sampleCount then means nothing. Levels of
// detail get finer with the number of samples that is expected.
struct StopSettings {
    // RMSE of the display-encoded image at EV 0, estimated from how the means of blocks differ; 1e-6 … 1.
    std::optional<double> targetError;
    // s since the frame was started, 0.001 … 1e6; at least one block is drawn, and no block is begun that would end
    // later.
    std::optional<double> timeLimit;
    std::uint32_t sampleLimit = mostSamples;  // the most samples, 1 … mostSamples
    // Does the number of samples follow from the picture or from time?
    [[nodiscard]] bool given() const { return targetError || timeLimit; }
};

// Why a frame got no more samples.
enum class StopReason {
    sampleCount,     // it has all that were asked for
    targetError,     // StopSettings
    timeLimit,       // StopSettings
    nothingBlurred,  // more would only smooth edges further: those that remain are RenderStatistics::samples
};

// Where the frame's time lies in the exposure.
enum class ShutterPosition { start, centre, end };

// How long the shutter is open, and how what moves meanwhile is followed.
struct ShutterSettings {
    double seconds = 0;  // that the shutter stays open; 0: everything stands still
    ShutterPosition position = ShutterPosition::centre;
    std::uint32_t motionSegments = 1;  // straight lines that a vertex's way is cut into, 1 … 64
    bool exactMotion = false;          // a pose of its own for each sample instead
    bool operator==(const ShutterSettings&) const = default;
};

// Pixels of the layer that a lens sample is drawn into.
enum class LayerFormat {
    automatic,  // rgba16f, or rgba32f where the scene's radiance may exceed 6e4
    rgba16f,    // half floats: 2⁻¹¹ relative error a sample
    rgba32f,    // references
    rgb9e5,     // 32 bits with a shared exponent, dithered over the samples: half the memory; opaque scenes only
    rgba8,      // clips at 1: a bound for the table of formats, not for pictures
};

}  // namespace defocus
