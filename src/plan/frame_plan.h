#pragma once
// FramePlan: everything decided about a frame before a GL call is made, as plain data that can be printed, tested and
// compared without a GPU. A renderer only executes it.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lens/circle_of_confusion.h"
#include "lens/lens_samples.h"
#include "plan/view.h"

namespace defocus {

// When a sample is taken: at `fraction` of the way from a moment of the shutter to the next.
struct SampleMoment {
    std::uint32_t moment = 0;
    float fraction = 0;  // [0, 1); 0 at the last moment
};

// A level of an object and the lens samples that draw it.
struct LevelDraw {
    std::uint32_t level = 0;
    std::uint32_t firstSample = 0;  // into FramePlan::samples
    std::uint32_t sampleCount = 0;
    std::uint32_t triangleCount = 0;  // of the level, all primitives, less what ObjectPlan::visible leaves out
};

// What is left of a level without the clusters that no lens sample shows; see visibility.h.
struct VisibleLevel {
    std::uint32_t level = 0;
    std::vector<std::vector<IndexRange>> primitives;  // runs into Pyramid::indices, one list a primitive of the mesh
    std::uint32_t facingAway = 0;                     // triangles left out as they show their back to all of the lens
    std::uint32_t outside = 0;                        // triangles left out as they lie outside the image
};

// What it takes to keep C linear inside each drawn triangle, to RenderSettings::cocTolerance.
enum class Refinement {
    none,       // the triangles as they are
    split,      // along the kinks of C, and at the near plane before the shear
    subdivide,  // into small ones (C is curved), and split
};

// Where the vertices of an object are at one moment.
struct ObjectPose {
    std::vector<glm::dmat4> viewFromJoint;  // camera-relative, composed in double; one, for the object, without a skin
    std::vector<double> morphWeights;       // one a morph target of the mesh
    bool operator==(const ObjectPose&) const = default;
};

struct ObjectPlan {
    int object = -1;  // into World::pose.objects
    int mesh = -1;
    std::string name;
    glm::dmat4 viewFromObject{1.0};  // camera-relative, composed in double
    ObjectPose pose;                 // in the middle of the exposure
    std::vector<ObjectPose> motion;  // at the moments of the shutter; empty: it stands still before the camera
    bool skinned = false;
    bool deformed = false;      // by its skin or by morph targets
    Bounds viewBox;             // around all that the frame shows of it, in view space
    double nearestDepth = 0;    // m, of the bounding box; ≤ near plane when the box reaches it
    double farthestDepth = 0;   // m
    CocRange coc;               // px, over the box
    CocDeviation cocDeviation;  // px, of the drawn levels
    double projectedEdge = 0;   // mean edge of level 0 in px at the nearest depth
    double lambda = 0;          // fractional level
    LevelDraw coarse;           // samples [0, n) at level ⌊λ⌋ + 1; none when λ is whole
    LevelDraw fine;             // samples [n, N) at level ⌊λ⌋
    // LodMode::continuous: where the two overlap by a sample (`coarse` then ends with sample n), the share of that
    // sample's pixels that draw `coarse`; the others draw `fine`.
    double boundaryShare = 0;
    std::vector<VisibleLevel> visible;  // of the levels that are drawn; any other is drawn whole
    double cocScale = 1;                // of the object's blur, ≥ 0
    Refinement refinement = Refinement::none;
    bool mirrored = false;  // the transform flips winding
    bool blended = false;   // has alpha-blended primitives
};

struct LeftOut {
    std::string what;  // "object Fish 3", "lens samples", "texture path", …
    std::string reason;
};

struct FramePlan {
    View view;
    RenderSettings settings;
    LodThresholds thresholds;  // of settings, what they leave open by the number of samples
    double tanHalfHorizontal = 0;
    double apertureDiameter = 0;  // m; 0 when the lens is left out
    ClipCircleOfConfusion coc;
    std::vector<LensSample> samples;         // those that are drawn, in order
    std::vector<SampleMoment> moments;       // one a sample; empty: nothing moves during the exposure
    std::vector<glm::dmat4> middleFromView;  // of cameras at the moments of the shutter; empty: the camera stands still
    std::vector<ObjectPlan> objects;         // those that are drawn, front to back
    std::vector<LeftOut> leftOut;
    std::vector<std::vector<bool>> levelsUsed;  // per mesh and level: does any object draw it
    bool usesLens = true;                       // false: nothing is blurred by half a pixel, only antialiasing samples
    bool usesCocControls = false;               // C isn't a + b·w for all that is drawn
    bool usesCocScales = false;                 // some of what is drawn scales its blur
    bool usesTextures = false;
    bool usesBlending = false;
    bool needsAlpha = false;                  // transparent background: the accumulation keeps coverage
    std::uint64_t trianglesDrawn = 0;         // over all samples
    std::uint64_t trianglesFacingAway = 0;    // over all samples, of the drawn levels: left out with their clusters
    std::uint64_t trianglesOutside = 0;       // the same
    std::uint64_t trianglesAtFullDetail = 0;  // over all samples: level 0, nothing left out
};

// Samples that remain when nothing is blurred: they only smooth edges.
inline constexpr std::uint32_t antialiasingSamples = 16;
// Blur below this diameter is left out (with keepAll it is not).
inline constexpr double leastBlur = 0.5;  // px

// What is left of `level`; null if it is drawn whole.
const VisibleLevel* visibleLevel(const ObjectPlan& object, std::uint32_t level);

// The sample that an object draws at both levels, each at its own pixels; none in most modes.
std::optional<std::uint32_t> boundarySample(const ObjectPlan& object);

// Throws Error for an impossible lens, size or sample count, and for a shutter whose moments don't fit together.
FramePlan planFrame(const World& world, const View& view, const RenderSettings& settings);

}  // namespace defocus
