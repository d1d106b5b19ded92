#pragma once
// Plan of a frame: which levels of detail each lens sample draws, and which parts of the scene are omitted and why.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "defocus/camera.h"
#include "defocus/export.h"
#include "defocus/lens.h"
#include "defocus/progress.h"
#include "defocus/request.h"
#include "defocus/settings.h"

namespace defocus {

// A level of detail of an object, and the range of lens samples that draw this level.
struct PlannedDraw {
    std::uint32_t level = 0;
    std::uint32_t triangles = 0;    // triangles drawn per sample, without those that no lens point sees
    std::uint32_t firstSample = 0;  // index of the first sample that draws this level
    std::uint32_t sampleCount = 0;
};

struct PlannedObject {
    std::string name;
    double nearestDepth = 0;   // min depth of the bounding box, m
    double farthestDepth = 0;  // max depth of the bounding box, m
    // Diameters of the circle of confusion in px: signed (> 0 behind the focus plane) at the nearest and farthest
    // depth, then min and max of the unsigned diameter over the bounding box. Infinite for a box that extends to the
    // camera.
    double nearestCoc = 0;
    double farthestCoc = 0;
    double smallestCoc = 0;
    double largestCoc = 0;
    double projectedEdge = 0;  // mean edge length of level 0 (full detail), seen at the nearest depth, px
    double lambda = 0;         // fractional level of detail λ (Jeong, Kim and Lee 2011)
    double pixelRate = 1;      // resolution per axis relative to the image's; < 1 for strong blur (method "multirate")
    bool blended = false;      // true if the object has alpha-blended materials
    bool transmits = false;    // true if the object has transmissive materials
    bool moves = false;        // true if the object moves during the exposure
    std::vector<PlannedDraw> draws;  // one or two draws; the one with the coarser level first
    // For a sample that mixes both levels (LodMode::continuous): fraction of the pixels in which it draws the coarser
    // level.
    std::optional<double> boundaryShare;
};

struct PlannedShadowMap {
    int light = 0;         // index of the light in the frame
    int face = -1;         // face 0 … 5 (+x −x +y −y +z −z) of a cube around the light; −1: single map
    double lightSize = 0;  // directional light: angular diameter in radians; other lights: radius in m
};

struct LeftOutPart {
    std::string what;  // name of the omitted part of the scene, e.g. "object Fish 3" or "texture path"
    std::string reason;
};

struct Plan {
    ImageSize size;
    bool transparent = false;  // true if the image has alpha
    // Camera: position in m, and axes as unit vectors, in world space.
    Vector3 cameraPosition{};
    Vector3 cameraRight{};
    Vector3 cameraUp{};
    Vector3 cameraBack{};
    // Lens settings in effect: from the request, else the file, else the defaults. Unset blur limits are infinite.
    LensSettings lens;
    bool hasApertureImage = false;
    double focusDistance = 0;     // focus distance in m; +∞ for focus at infinity
    double apertureDiameter = 0;  // m
    bool usesLens = true;         // false: no blur reaches half a pixel, so a pinhole image is drawn
    std::uint32_t samples = 0;    // number of lens samples
    std::uint32_t positions = 1;  // number of subpixel positions per lens sample
    Sequence sequence = Sequence::sobol;
    std::uint32_t seed = 0;
    double cocTolerance = 0;          // tolerance in px; see Request::cocTolerance
    std::uint64_t moments = 0;        // number of instants at which the scene is posed; 0: nothing moves
    std::uint64_t movingObjects = 0;  // number of objects that move during the exposure
    // Settings of the levels of detail; thresholds that the Request leaves unset have their defaults here.
    LodMode lod = LodMode::fractional;
    LodMetric lodMetric = LodMetric::automatic;
    LodCoc lodCoc = LodCoc::smallest;
    LevelVertices levelVertices = LevelVertices::fitted;
    double blurThreshold = 0;   // target edge length relative to the blur diameter
    double sizeThreshold = 0;   // target edge length where nothing is blurred, px
    double lightThreshold = 0;  // max product of edge length (px) and shading error; see Request::lightThreshold
    // Shadow maps and their sampling.
    std::vector<PlannedShadowMap> shadowMaps;  // empty: no shadows
    int shadowMapSize = 0;                     // side of each shadow map, px
    std::uint32_t shadowPoints = 0;            // sample points on each light per lens sample
    // Standard deviation of the blur by which method "multirate" fills the gaps between the lens samples, relative to
    // the diameter of the circle of confusion. 0 if the samples' images cannot be blurred; lensCellReason then says
    // why.
    double lensCellBlur = 0;
    std::string lensCellReason;
    std::string accumulationReason;      // why method "auto" uses accumulation; empty: "auto" uses multirate
    std::vector<PlannedObject> objects;  // sorted from front to back
    std::vector<LeftOutPart> leftOut;
    // Numbers of triangles, summed over all samples. Triangles that face away or are outside the image are culled.
    std::uint64_t trianglesDrawn = 0;
    std::uint64_t trianglesFacingAway = 0;
    std::uint64_t trianglesOutside = 0;
    std::uint64_t trianglesAtFullDetail = 0;
};

// Returns the plan for a request, without rendering and without a GPU. Throws the errors of SceneRenderer's
// constructor.
DEFOCUS_API Plan plan(const Request& request, const Progress& progress = {});

// Returns the plan as JSON, like `defocus plan --json`. Infinite values are null.
DEFOCUS_API std::string toJson(const Plan& plan);

}  // namespace defocus
