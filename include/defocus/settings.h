#pragma once
// Enumerations and limits for Request: samples, levels of detail, shadows, shutter and layers. docs/settings.md
// explains each value with its range and default.

#include <cstdint>
#include <variant>

namespace defocus {

inline constexpr std::uint32_t maxSamples = 65'536;  // max lens samples per frame
inline constexpr int maxImageSide = 16'384;          // max width and height of an image, px

// Target error of a frame with an automatic number of samples: a FLIP of about 0.03 (draft), 0.01 (good) or 0.005
// (fine) against the converged image.
enum class Quality { draft, good, fine };

// Low-discrepancy sequences for sample points on the lens, in the pixel and in the exposure. All are infinite, and
// every prefix is well distributed.
enum class Sequence {
    // Halton points: bases 2, 3 on the lens and 5, 7 in the pixel (Jeong, Kim and Lee 2011), then 11, 13, 17 and 19 in
    // the exposure time, in the spectrum and on the lights.
    halton,
    scrambledHalton,  // Halton points with random permutations of each digit, which depend on the preceding digits
    sobol,            // Owen-scrambled Sobol points
    r2,               // additive recurrence with powers of the plastic number (R2 sequence)
};

// Level-of-detail mode. Objects are drawn with simplified meshes if their blur or size hides the simplification (Jeong,
// Kim and Lee 2011). Each object has a fractional level λ, a real number: 0 is full detail, larger values are coarser.
enum class LodMode {
    fractional,  // some lens samples draw level ⌊λ⌋ (λ rounded down), the others the next coarser level
    continuous,  // like fractional, but one lens sample may draw both levels, in different pixels
    nearest,     // all lens samples draw the level nearest to λ
    off,         // all lens samples draw level 0, full detail
};

// Criterion that determines the fractional level of detail λ of an object.
enum class LodMetric {
    automatic,  // `size` if a blur or size threshold is set, else `measured`
    size,       // target in px for the level's mean edge length
    error,      // target in px for the deviation of the level's surface from the full mesh
    measured,   // target for the error of the blurred radiance, relative to the radiance's standard deviation
    // Level proportional to the blur at the bounding box's centre, and to the reciprocal of the box's projected size
    // (Jeong, Kim and Lee 2011).
    proportional,
    // Like `size`, but the target edge length depends on the blur only, and it is compared with the edge length
    // projected at the object's centre (Tzeng et al. 2012).
    score,
};

// Circle of confusion that determines an object's level of detail.
enum class LodCoc {
    smallest,  // smallest blur within the object's bounding box
    centre,    // blur at the bounding box's centre (Jeong, Kim and Lee 2011)
};

// Source of the vertices of coarser levels.
enum class LevelVertices {
    fitted,     // positions, normals, colours and texture coordinates fitted to full detail
    surviving,  // vertices of the full-detail mesh, with their positions and attributes
    quarters,   // like surviving, but three levels with 100, 75 and 50 % of the vertices (Tzeng et al. 2012)
};

// Shadows from lights and from the environment.
enum class Shadows {
    automatic,  // shadows are on if Request::ground is set
    on,
    off,
};

// Whether the frame's animation time is the start, the centre or the end of the exposure.
enum class ShutterPosition { start, centre, end };

// Exact motion: the scene is posed separately for each lens sample, so that the paths of vertices are exact.
struct ExactMotion {
    bool operator==(const ExactMotion&) const = default;
};

// Number of straight segments in a vertex's path during the exposure, 1 … 64, or ExactMotion.
using MotionSegments = std::variant<std::uint32_t, ExactMotion>;

// Pixel format of the texture layers, each of which holds the image of one lens sample.
enum class LayerFormat {
    automatic,  // rgba16f, or rgba32f if the scene's radiance may exceed 6e4
    rgba16f,    // half floats: relative rounding error 2⁻¹¹ per sample
    rgba32f,    // 32-bit floats, for reference images
};

// Reason why no further samples were added to a frame.
enum class StopReason {
    sampleCount,     // all requested samples have been drawn
    targetError,     // the estimated error is below Request::targetError
    timeLimit,       // Request::timeLimit has elapsed
    nothingBlurred,  // nothing is blurred, so more samples would only antialias edges
};

}  // namespace defocus
