#pragma once
// A FramePlan holds all decisions about a frame that are made before the first OpenGL call. It is plain data, so it can
// be printed, tested and compared without a GPU. Renderers only execute it.

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

// Time of a lens sample within the exposure. The scene is posed at a few times, the shutter times; the sample
// interpolates between two of them.
struct SampleMoment {
    std::uint32_t moment = 0;
    float fraction = 0;  // interpolation weight of the next shutter time, [0, 1); 0 at the last shutter time
    float time = 0;      // time within the exposure, [0, 1)
};

// One level of an object, and the range of lens samples that draw it.
struct LevelDraw {
    std::uint32_t level = 0;
    std::uint32_t firstSample = 0;  // index into FramePlan::samples
    std::uint32_t sampleCount = 0;
    // number of triangles of all primitives, without culled triangles (see ObjectPlan::visible)
    std::uint32_t triangleCount = 0;
};

// The part of a level that remains after culling clusters that no lens sample sees; see visibility.h.
struct VisibleLevel {
    std::uint32_t level = 0;
    std::vector<std::vector<IndexRange>> primitives;  // index ranges in Pyramid::indices, one list per primitive
    std::uint32_t facingAway = 0;                     // triangles culled because they face away from the entire lens
    std::uint32_t outside = 0;                        // triangles culled because they lie outside the image
};

// How an object's triangles are divided. Inside each part, linear interpolation of the clip-space blur (CoC · depth,
// see circle_of_confusion.h) then has an error of at most RenderSettings::cocTolerance.
enum class Refinement {
    none,  // triangles are drawn undivided
    // Triangles are cut where the slope of the clip-space blur jumps. They are also cut at the near plane, before the
    // lens shifts their vertices.
    split,
    // Triangles are divided into small ones, because the clip-space blur is not linear inside them. If ObjectPlan::cuts
    // is set, the small triangles are also cut as with `split`.
    subdivide,
};

inline constexpr std::uint32_t maxEdgeParts = 64;  // max parts per edge; OpenGL's tessellator supports at least 64

// Vertex transforms and morph weights of an object at one instant.
struct ObjectPose {
    // Transforms to view space, one per joint of the skin, computed in double precision. An object without a skin has
    // one transform, from object space.
    std::vector<glm::dmat4> viewFromJoint;
    std::vector<double> morphWeights;  // one weight per morph target of the mesh
    bool operator==(const ObjectPose&) const = default;
};

struct ObjectPlan {
    int object = -1;  // index into World::pose.objects
    int mesh = -1;
    std::string name;
    glm::dmat4 viewFromObject{1.0};  // transform from object space to view space, computed in double precision
    ObjectPose pose;                 // pose halfway through the exposure
    // Poses at the shutter times (see Shutter in plan/view.h); empty if the object doesn't move relative to the camera.
    std::vector<ObjectPose> motion;
    bool skinned = false;
    bool deformed = false;     // true: the skin or morph targets deform the mesh
    Bounds viewBox;            // bounding box in view space over the entire exposure
    double nearestDepth = 0;   // nearest depth of the bounding box in m; may be less than View::nearPlane
    double farthestDepth = 0;  // farthest depth of the bounding box in m
    // CoC in px over the bounding box. `smallest` is also the min over all focus distances of RenderSettings::refocus.
    CocRange coc;
    CocDeviation cocDeviation;  // bounds in px of the error of interpolating the CoC inside the drawn triangles
    double projectedEdge = 0;   // projected mean edge length of level 0 at the nearest depth, px
    double lambda = 0;          // fractional level of detail λ
    // Level ⌊λ⌋ + 1, the coarser of the two levels around the fractional level λ. The first samples of the plan draw
    // it; no sample does if λ is an integer, or with LodMode::nearest.
    LevelDraw coarse;
    // Level ⌊λ⌋, the finer level, drawn by the samples that do not draw `coarse`. With LodMode::nearest, level
    // round(λ), drawn by all samples.
    LevelDraw fine;
    // With LodMode::continuous, the last sample of `coarse` is also the first sample of `fine`. In this shared sample,
    // `coarse` is drawn in this fraction of the pixels, and `fine` in the others. 0 if no sample is shared.
    double boundaryShare = 0;
    std::vector<VisibleLevel> visible;  // levels of which some clusters are culled; other levels are drawn completely
    double cocScale = 1;                // factor on the blur of the entire object, ≥ 0
    OwnBlur own;                        // bounds of the surfaces' blur factor and added blur
    bool blurMoves = false;             // true: the blur that some vertices add changes during the exposure
    Refinement refinement = Refinement::none;
    // Max number of parts into which Refinement::subdivide divides an edge.
    std::uint32_t maxParts = maxEdgeParts;
    bool cuts = false;       // true: refined triangles may reach the near plane, or contain a jump in the CoC's slope
    bool mirrored = false;   // true: the transform flips the winding of triangles
    bool blended = false;    // true: the object has alpha-blended primitives
    bool transmits = false;  // true: the object has transmissive primitives
    bool ground = false;     // true: the object is the ground plane, which casts no shadow
};

// An alpha-blended or transmissive primitive of an object, or some of its triangles: an entry of the drawing order.
struct BlendRun {
    std::uint32_t object = 0;     // index into FramePlan::objects
    std::uint32_t primitive = 0;  // index into Mesh::primitives
    std::uint32_t level = 0;      // level whose triangles are listed in `triangles`
    // Ranges in Pyramid::indices, back to front. Empty: the entire primitive, at all levels that are drawn.
    std::vector<IndexRange> triangles;
    // true: each lens sample draws a fragment with probability alpha, else discards it, so that the drawing order
    // doesn't matter. false: fragments are blended over the surfaces behind them.
    bool stochastic = false;
};

// One shadow map of a light, rendered for each lens sample. A point light inside the scene has six maps.
struct ShadowMap {
    int light = 0;  // index into World::lights, or `surroundings` (shadows.h) for the environment
    // Face of a cube around the light: +x, −x, +y, −y, +z, −z. −1 if a single map contains all shadow casters.
    int face = -1;
    double lightSize = 0;  // for a directional light, angular diameter in radians; for other lights, radius in m
};

// Shadow maps of the lights that cast shadows, and the objects that cast them; see shadows.h.
struct ShadowPlan {
    std::vector<ShadowMap> maps;  // maps of the same light are adjacent; empty: no shadows
    int size = 0;                 // width and height of each map, px
    std::uint32_t points = 1;     // sample points on each light per lens sample
    // Objects that cast shadows. Each is drawn with one level, ObjectPlan::fine, in all samples
    std::vector<ObjectPlan> casters;
    // Corners of boxes that contain all casters (relative to the camera, in m, world axes).
    std::vector<glm::dvec3> corners;
    // Corners of a volume that contains everything visible in any lens sample (relative to the camera, in m, world
    // axes). Shadow maps need not extend beyond this volume.
    std::vector<glm::dvec3> seen;
    double casterError = 0;  // max deviation of the casters' levels from full detail, m
};

struct LeftOut {
    std::string what;  // name of the omitted part: "object Fish 3", "lens samples", "texture path", …
    std::string reason;
};

struct FramePlan {
    View view;
    std::optional<Tile> tile;  // part of the image to draw; nullopt: the entire image
    RenderSettings settings;
    LodThresholds thresholds;  // settings.thresholds; unset values get defaults that depend on the number of samples
    double tanHalfHorizontal = 0;
    double apertureDiameter = 0;  // diameter in m; 0 for a pinhole, which also replaces a lens without visible blur
    // Upper bound of the CoC in px over the drawn objects and a visible background of varying colour. The bound is
    // computed from bounding boxes and is infinite if a box reaches the near plane. The value is also set if the frame
    // uses a pinhole because the blur is too small to be visible.
    double largestBlur = 0;
    ClipCircleOfConfusion coc;
    std::vector<LensSample> samples;  // samples to draw, in this order
    // Samples [frameFirst, frameSamples) of the sequence were planned together; `samples` may hold only some of them.
    // `frameSamples` is the number of samples of the frame once these are drawn.
    std::uint32_t frameSamples = 0;
    std::uint32_t frameFirst = 0;
    std::vector<SampleMoment> moments;  // one per sample; empty if nothing moves during the exposure
    // Transforms from view space at each shutter time to view space in the middle of the exposure; empty if the camera
    // doesn't move.
    std::vector<glm::dmat4> middleFromView;
    std::vector<ObjectPlan> objects;   // front to back, followed by unseen objects if settings.keepAll is set
    std::vector<BlendRun> blendOrder;  // all alpha-blended and transmissive primitives, back to front
    ShadowPlan shadows;
    std::vector<LeftOut> leftOut;
    std::vector<std::vector<bool>> levelsUsed;  // [mesh][level]: true if any object draws the level
    bool usesLens = true;                       // false: no blur reaches half a pixel, so samples only antialias edges
    // true: the blur of some object differs from a thin lens's blur, because the lens or the object has blur controls
    bool usesCocControls = false;
    bool usesOwnBlur = false;  // true: an object or a vertex modifies the lens's blur
    bool usesTextures = false;
    bool usesBlending = false;   // true: some object is alpha-blended
    bool sortsBlending = false;  // true: some primitive is blended in order from back to front
    bool usesTransmission = false;
    bool needsAlpha = false;  // true: the background is transparent, so alpha is accumulated, too
    bool showsMap = false;    // true: the background is an environment map
    // Triangle counts, summed over all samples.
    std::uint64_t trianglesDrawn = 0;
    std::uint64_t trianglesFacingAway = 0;    // triangles culled because their clusters face away
    std::uint64_t trianglesOutside = 0;       // triangles culled because their clusters lie outside the image
    std::uint64_t trianglesAtFullDetail = 0;  // triangles at level 0 of the drawn objects, without culling
};

// Number of samples for antialiasing if nothing is blurred.
inline constexpr std::uint32_t antialiasingSamples = 16;
// A frame is drawn with a pinhole if all CoC diameters are below this value, unless RenderSettings::keepAll is set.
inline constexpr double minBlur = 0.5;  // px

// Returns the plan of the same frame without objects, which draws only the background.
FramePlan withoutObjects(FramePlan plan);

// Returns the unculled part of `level`, or null if the level is drawn completely.
const VisibleLevel* visibleLevel(const ObjectPlan& object, std::uint32_t level);

// Returns the index of the sample that draws the object's coarse level at some pixels and the fine level at the others.
// nullopt if there is no such sample; only LodMode::continuous has one.
std::optional<std::uint32_t> boundarySample(const ObjectPlan& object);

// Plans a frame. Throws Error if the lens, the size, the number of samples or the shutter times are invalid.
FramePlan planFrame(const World& world, const View& view, const RenderSettings& settings);

}  // namespace defocus::engine
