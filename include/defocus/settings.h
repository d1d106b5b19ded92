#pragma once
// Values that a Request chooses from: samples, levels of detail, shadows, shutter, layers. docs/settings.md explains
// each value and gives its range and default.

#include <cstdint>
#include <variant>

namespace defocus {

inline constexpr std::uint32_t maxSamples = 65'536;  // lens samples of a frame
inline constexpr int maxImageSide = 16'384;          // px, of an image's width and of its height

// Low-discrepancy sequences for points on the lens, in the pixel and in the exposure. All are infinite, and each prefix
// is well spread.
enum class Sequence {
    halton,           // bases 2, 3 on the lens and 5, 7 in the pixel, as in Jeong, Kim and Lee 2011; then 11 and 13
    scrambledHalton,  // Halton with random digit permutations, each dependent on the digits before it
    sobol,            // six dimensions, Owen-scrambled
    r2,               // additive recurrence by powers of the plastic number
};

// Simplified meshes for objects whose blur or size hides the difference (Jeong, Kim and Lee 2011).
enum class LodMode {
    fractional,  // samples split between levels ⌊λ⌋ and ⌊λ⌋ + 1
    continuous,  // like fractional, and the sample at the boundary is split over its pixels
    nearest,     // all samples draw level round(λ)
    off,         // full detail
};

// The measure by which levels are chosen.
enum class LodMetric {
    automatic,  // `size` if a blur or size threshold is given, else `measured`
    size,       // target edge length in px, against the levels' mean edges
    error,      // target geometric deviation in px
    halving,    // target edge length in px, assuming that each level halves the triangles (Jeong, Kim and Lee 2011)
    measured,   // target error of the light that a blur leaves, relative to its variation
    score,      // target edge length by blur alone, against the edges at the object's centre (Tzeng et al. 2012)
};

// The circle of confusion that an object's level may count on.
enum class LodCoc {
    smallest,  // over the object's bounding box
    centre,    // at the box's centre (Jeong, Kim and Lee 2011)
};

// Vertices of coarser levels.
enum class LevelVertices {
    fitted,     // positions, normals, colours and texture coordinates are fitted to full detail
    surviving,  // vertices of full detail, unchanged
    quarters,   // surviving vertices, in three levels of 100, 75 and 50 % (Tzeng et al. 2012)
};

// Whether lights and surroundings cast shadows.
enum class Shadows {
    automatic,  // on if the request has a ground
    on,
    off,
};

// Where the frame's time lies in the exposure.
enum class ShutterPosition { start, centre, end };

// Each lens sample has its own pose of the scene, instead of vertices that move along straight segments.
struct ExactMotion {
    bool operator==(const ExactMotion&) const = default;
};

// Straight segments of a vertex's path while the shutter is open, 1 … 64.
using MotionSegments = std::variant<std::uint32_t, ExactMotion>;

// Pixel format of the layer that a lens sample is drawn into.
enum class LayerFormat {
    automatic,  // rgba16f, or rgba32f if the scene's radiance may exceed 6e4
    rgba16f,    // half floats: relative error 2⁻¹¹ a sample
    rgba32f,    // for references
    rgb9e5,
    rgba8,
};

// Why a frame got no more samples.
enum class StopReason {
    sampleCount,     // all requested samples are drawn
    targetError,     // Request::targetError is reached
    timeLimit,       // Request::timeLimit is over
    nothingBlurred,  // more samples would only smooth edges further
};

}  // namespace defocus
