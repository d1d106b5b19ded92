#pragma once
// The plan of a frame: which levels of detail each lens sample draws, and what is left out with the reason.

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

// One level of an object and the consecutive lens samples that draw it.
struct PlannedDraw {
    std::uint32_t level = 0;
    std::uint32_t triangles = 0;    // per sample, without triangles that no lens point can see
    std::uint32_t firstSample = 0;  // index into the frame's samples
    std::uint32_t sampleCount = 0;
};

struct PlannedObject {
    std::string name;
    double nearestDepth = 0;   // m, of the bounding box
    double farthestDepth = 0;  // m
    // Circle of confusion over the bounding box, as diameters in px. The first two are signed, > 0 behind the focus. A box
    // that reaches the camera has infinite values.
    double nearestCoc = 0;
    double farthestCoc = 0;
    double smallestCoc = 0;
    double largestCoc = 0;
    double projectedEdge = 0;          // px, mean edge length of level 0 at the nearest depth
    double lambda = 0;                 // fractional level
    double pixelRate = 1;              // share of the resolution along an axis that the object needs as a lens cell
    bool blended = false;              // has alpha-blended parts
    bool transmits = false;            // has transmitting parts
    bool moves = false;                // moves during the exposure
    std::vector<PlannedDraw> draws;    // 1 or 2, the coarser level first
    // LodMode::continuous: the share of pixels that draw the coarser level in the sample that draws both.
    std::optional<double> boundaryShare;
};

struct PlannedShadowMap {
    int light = 0;         // index of the light
    int face = -1;         // face of a cube around the light, +x −x +y −y +z −z; −1: one map for the light
    double lightSize = 0;  // directional light: angular diameter in radians; other lights: radius in m
};

struct LeftOutPart {
    std::string what;  // such as "object Fish 3" or "texture path"
    std::string reason;
};

struct Plan {
    ImageSize size;
    bool transparent = false;  // the image has alpha
    // Camera: position in m, and unit directions.
    Vector3 cameraPosition{};
    Vector3 cameraRight{};
    Vector3 cameraUp{};
    Vector3 cameraBack{};
    // Lens. All its numbers have a value, whether they come from the request, the file or the defaults.
    LensSettings lens;
    bool hasApertureImage = false;
    double focusDistance = 0;     // m; may be infinite
    double apertureDiameter = 0;  // m
    bool usesLens = true;         // false: no blur reaches half a pixel
    // Samples.
    std::uint32_t samples = 0;
    Sequence sequence = Sequence::sobol;
    std::uint32_t seed = 0;
    double cocTolerance = 0;          // px
    std::uint64_t moments = 0;        // moments at which the exposure is posed; 0: nothing moves
    std::uint64_t movingObjects = 0;  // objects that move
    // Levels of detail. The thresholds are those of Request, with their defaults filled in.
    LodMode lod = LodMode::fractional;
    LodMetric lodMetric = LodMetric::automatic;
    LodCoc lodCoc = LodCoc::smallest;
    LevelVertices levelVertices = LevelVertices::fitted;
    double blurThreshold = 0;
    double sizeThreshold = 0;
    double lightThreshold = 0;
    // Shadows.
    std::vector<PlannedShadowMap> shadowMaps;  // empty: no shadows
    int shadowMapSize = 0;                     // px per side
    std::uint32_t shadowPoints = 0;            // points on each light per lens sample
    // Method multirate: σ of the blur of a sample's image, relative to the circle of confusion. 0 if the frame cannot be
    // blurred, with the reason.
    double lensCellBlur = 0;
    std::string lensCellReason;
    std::vector<PlannedObject> objects;  // front to back
    std::vector<LeftOutPart> leftOut;
    // Triangles, as sums over all samples. The two middle ones were culled from the drawn levels.
    std::uint64_t trianglesDrawn = 0;
    std::uint64_t trianglesFacingAway = 0;
    std::uint64_t trianglesOutside = 0;
    std::uint64_t trianglesAtFullDetail = 0;
};

// Plans the frame of a request. Needs no GPU and renders nothing. Throws Error like SceneRenderer.
DEFOCUS_API Plan plan(const Request& request, const Progress& progress = {});

// Returns the plan as `defocus plan --json` prints it. Infinite values are null.
DEFOCUS_API std::string toJson(const Plan& plan);

}  // namespace defocus
