#include "frame/setup/levels.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <limits>
#include <optional>

#include "lens/circle_of_confusion.h"
#include "render/sampling/automatic_samples.h"

namespace defocus::engine {

namespace {

// Levels of detail are worth building if an image draws each triangle at least this many times on average.
// Building takes 8 to 28 µs of CPU time per triangle (bench/results/llvmpipe-cold.txt); drawing a triangle once takes
// a fraction of a microsecond. A single image would need more draws to recover that time, but later images read the
// levels from the cache. Images with fewer draws have little blur, so levels would save little.
constexpr double payingDraws = 64;

// Returns whether the request sets any option of the levels of detail: mode, thresholds, metric or vertices.
bool asksForLevels(const Request& request) {
    const Request defaults;
    return request.lod || request.blurThreshold || request.sizeThreshold || request.lightThreshold ||
           request.lodMetric != defaults.lodMetric || request.lodCoc != defaults.lodCoc ||
           request.levelVertices != defaults.levelVertices;
}

// Returns the largest diameter of the circle of confusion in px over the scene's bounding box. Ignores the ground and
// the blur scales of individual objects. Returns infinity if the box reaches the near plane.
double largestBlur(const PreparedFrame& frame) {
    const View& view = frame.view;
    const Bounds& box = frame.world.pose.bounds;
    if (!view.lens.dofEnabled || box.empty()) return 0;
    const glm::dmat4 viewFromWorld = glm::inverse(view.worldFromCamera);
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0;
    for (const glm::dvec3& corner : box.corners()) {
        const double depth = -(viewFromWorld * glm::dvec4(corner, 1)).z;
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    if (!(nearest > view.nearPlane)) return std::numeric_limits<double>::infinity();
    const CocBox all{.zNear = nearest, .zFar = farthest, .ndcMin = glm::dvec2(-1), .ndcMax = glm::dvec2(1)};
    const ClipCircleOfConfusion coc = clipCircleOfConfusion(view.lens, view.width, view.height);
    return circleOfConfusionRange(coc, all, view.width).largest;
}

// Returns how often one lens sample draws a triangle of a mesh, on average over the triangles of all meshes. A triangle
// is drawn once for each object that uses its mesh.
double drawsPerSample(const PreparedFrame& frame) {
    double built = 0;
    for (const Mesh& mesh : frame.scene->meshes) built += static_cast<double>(mesh.triangleCount());
    double drawn = 0;
    for (const Object& object : frame.world.pose.objects)
        drawn += static_cast<double>(frame.scene->meshes[static_cast<std::size_t>(object.mesh)].triangleCount());
    return built > 0 ? drawn / built : 0;
}

}  // namespace

void chooseLevels(PreparedFrame& frame, const Request& request) {
    const std::optional<Quality> quality = stopSettings(request).automatic;
    if (!quality || asksForLevels(request)) return;
    if (drawsPerSample(frame) * firstSamples(largestBlur(frame), *quality) >= payingDraws) return;
    frame.settings.lod = LodMode::off;
    frame.cacheFolder.clear();
}

}  // namespace defocus::engine
