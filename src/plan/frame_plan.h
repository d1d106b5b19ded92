#pragma once
// A FramePlan holds everything that is decided about a frame before the first GL call. It is plain data, so it can be
// printed, tested and compared without a GPU. A renderer only executes it.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lens/circle_of_confusion.h"
#include "lens/lens_samples.h"
#include "plan/view.h"
#include "plan/visible/tiles.h"

namespace defocus::engine {

// The time of a sample.
struct SampleMoment {
    std::uint32_t moment = 0;
    float fraction = 0;  // of the way from this moment of the shutter to the next, [0, 1); it is 0 at the last moment
    float time = 0;      // of the exposure, [0, 1)
};

// One level of an object, and the lens samples that draw it.
struct LevelDraw {
    std::uint32_t level = 0;
    std::uint32_t firstSample = 0;  // into FramePlan::samples
    std::uint32_t sampleCount = 0;
    std::uint32_t triangleCount = 0;  // of all primitives, without what ObjectPlan::visible leaves out
};

// The part of a level that remains when the clusters that no lens sample shows are left out; see visibility.h.
struct VisibleLevel {
    std::uint32_t level = 0;
    std::vector<std::vector<IndexRange>> primitives;  // runs in Pyramid::indices, one list for each primitive
    std::uint32_t facingAway = 0;                     // triangles left out because all of the lens sees their back
    std::uint32_t outside = 0;                        // triangles left out because they lie outside the image
};

// How the triangles of an object are divided so that C is linear inside each of them, within
// RenderSettings::cocTolerance.
enum class Refinement {
    none,       // not at all
    split,      // they are cut along the kinks of C, and at the near plane before the shear
    subdivide,  // they are divided into small ones, because C is curved, and then split
};

// The positions of an object's vertices at one moment.
struct ObjectPose {
    // Relative to the camera, composed in double. An object without a skin has one matrix.
    std::vector<glm::dmat4> viewFromJoint;
    std::vector<double> morphWeights;  // one for each morph target of the mesh
    bool operator==(const ObjectPose&) const = default;
};

struct ObjectPlan {
    int object = -1;  // into World::pose.objects
    int mesh = -1;
    std::string name;
    glm::dmat4 viewFromObject{1.0};  // relative to the camera, composed in double
    ObjectPose pose;                 // in the middle of the exposure
    std::vector<ObjectPose> motion;  // at the moments of the shutter; empty if it doesn't move relative to the camera
    bool skinned = false;
    bool deformed = false;      // its skin or its morph targets move vertices against each other
    Bounds viewBox;             // view space; it contains the object at all moments of the frame
    double nearestDepth = 0;    // m, of the bounding box; ≤ near plane if the box reaches it
    double farthestDepth = 0;   // m
    CocRange coc;               // px, over the box
    CocDeviation cocDeviation;  // px, of the drawn levels
    double projectedEdge = 0;   // px; the mean edge of level 0 at the nearest depth
    double lambda = 0;          // fractional level
    LevelDraw coarse;           // samples [0, n) draw level ⌊λ⌋ + 1; there are none if λ is an integer
    LevelDraw fine;             // samples [n, N) draw level ⌊λ⌋
    // With LodMode::continuous, `coarse` and `fine` may share sample n. Then this share of its pixels draws `coarse`,
    // and the others draw `fine`.
    double boundaryShare = 0;
    // What method "multirate" shares of it among lens samples, as an earlier frame had it; else it follows from the
    // blur (plan/rates.h).
    std::optional<double> heldLensShare;
    std::vector<VisibleLevel> visible;  // levels that are drawn in part; a level that isn't here is drawn whole
    double cocScale = 1;                // factor on the object's blur, ≥ 0
    OwnBlur own;                        // what its surfaces make of the lens's blur
    bool blurMoves = false;             // its vertices have a blur of their own that changes while the shutter is open
    Refinement refinement = Refinement::none;
    bool mirrored = false;   // the transform flips the winding of triangles
    bool blended = false;    // it has alpha-blended primitives
    bool transmits = false;  // it has primitives that show what lies behind them
    bool ground = false;     // it is what the scene stands on, and casts no shadow
};

// A shadow map that each lens sample has: of a light, and of a point light amid the scene one of six.
struct ShadowMap {
    int light = 0;  // into World::lights; surroundings: those
    int face = -1;  // of a cube around the light: +x, −x, +y, −y, +z, −z; −1: one map shows all that can cast a shadow
    double lightSize = 0;  // of a directional light its angular diameter, radians; of others their radius, m
};

// What casts shadows, and from which lights; see shadows.h.
struct ShadowPlan {
    std::vector<ShadowMap> maps;      // those of a light follow each other; empty: nothing casts a shadow
    int size = 0;                     // px a side, of each map
    std::uint32_t points = 1;         // on each light, for one lens sample
    std::vector<ObjectPlan> casters;  // each drawn at one level, `fine`, for all samples
    std::vector<glm::dvec3> corners;  // m from the camera along the world's axes: of boxes that hold all casters
    std::vector<glm::dvec3> seen;     // the same, of what the whole frame shows: maps needn't reach farther
    double casterError = 0;           // m by which the casters' levels lie off full detail, at most
};

struct LeftOut {
    std::string what;  // "object Fish 3", "lens samples", "texture path", …
    std::string reason;
};

struct FramePlan {
    View view;
    std::optional<Tile> tile;  // the part of the image that is drawn; none: all of it
    RenderSettings settings;
    LodThresholds thresholds;  // of settings, what they leave open by the number of samples
    double tanHalfHorizontal = 0;
    double apertureDiameter = 0;  // m; 0 if the lens is left out
    // px, over what may be drawn, and that of an endless background where it isn't the same everywhere. It stands here
    // even if the lens is left out. Boxes bound it: an object that reaches the near plane makes it infinite.
    double largestBlur = 0;
    ClipCircleOfConfusion coc;
    std::vector<LensSample> samples;  // the samples to draw, in order
    // Samples of the sequence that the frame has in the end, and the first of those that were planned together with
    // these.
    std::uint32_t frameSamples = 0;
    std::uint32_t frameFirst = 0;
    std::vector<SampleMoment> moments;  // one for each sample; empty if nothing moves during the exposure
    // From the view at each moment of the shutter to the view in its middle; empty if the camera doesn't move.
    std::vector<glm::dmat4> middleFromView;
    std::vector<ObjectPlan> objects;  // the objects to draw, front to back
    ShadowPlan shadows;
    std::vector<LeftOut> leftOut;
    std::vector<std::vector<bool>> levelsUsed;  // [mesh][level]: whether any object draws it
    bool usesLens = true;          // false: no blur reaches half a pixel, and the samples only smooth edges
    bool usesCocControls = false;  // C differs from a + b·w somewhere
    bool usesOwnBlur = false;      // some object or vertex makes something of its own of the blur
    bool usesTextures = false;
    bool usesBlending = false;
    bool usesTransmission = false;
    bool needsAlpha = false;  // the background is transparent, so the accumulation keeps coverage
    // Sums over all samples.
    std::uint64_t trianglesDrawn = 0;
    std::uint64_t trianglesFacingAway = 0;  // left out of the drawn levels, because their clusters face away
    std::uint64_t trianglesOutside = 0;  // left out of the drawn levels, because their clusters lie outside the image
    std::uint64_t trianglesAtFullDetail = 0;  // what level 0 of the drawn objects has, with no cluster left out
};

// The number of samples that remain if nothing is blurred. They only smooth edges.
inline constexpr std::uint32_t antialiasingSamples = 16;
// If no blur is wider than this diameter, the lens is left out (unless keepAll is set).
inline constexpr double minBlur = 0.5;  // px

// Returns the part of `level` that is drawn, or null if all of it is drawn.
const VisibleLevel* visibleLevel(const ObjectPlan& object, std::uint32_t level);

// Returns the sample that an object draws at both levels, each at its own pixels. Only LodMode::continuous has one.
std::optional<std::uint32_t> boundarySample(const ObjectPlan& object);

// Throws Error if the lens, the size or the number of samples is impossible, or if the moments of the shutter don't fit
// together.
FramePlan planFrame(const World& world, const View& view, const RenderSettings& settings);

}  // namespace defocus::engine
