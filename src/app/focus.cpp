#include "app/focus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <vector>

#include "core/error.h"
#include "scene/pick.h"

namespace defocus {

namespace {

constexpr double defaultFocusDistance = 2.5;  // m, where the scene lies beside or behind the camera
constexpr int autoPoints = 9;                 // a side, over the image's central third

struct Seen {
    const Scene& scene;
    const Pose& pose;
    const View& view;
};

double depthOf(const View& view, const glm::dvec3& point) {
    return -(glm::inverse(view.worldFromCamera) * glm::dvec4(point, 1)).z;
}

double depthOfCentre(const Seen& seen) {
    const Bounds& bounds = seen.pose.bounds;
    const double depth = bounds.empty() ? 0 : depthOf(seen.view, bounds.centre());
    return depth > seen.view.nearPlane && std::isfinite(depth) ? depth : defaultFocusDistance;
}

double depthOfNode(const Seen& seen, const std::string& name) {
    const double depth = depthOf(seen.view, nodeCentre(seen.scene, seen.pose, nodeNamed(seen.scene, name)));
    if (!(depth > 0)) fail("--focus-node: the centre of '{}' lies behind the camera", name);
    return depth;
}

// The first surface behind a place of the image (px from its top left corner), in view space, for the field of view
// that `lens` has.
std::optional<glm::dvec3> surfaceAt(const Seen& seen, const Lens& lens, const glm::dvec2& place) {
    const View& view = seen.view;
    const double tanX = tanHalfHorizontalFov(lens);
    const double tanY = tanX * view.height / view.width;
    const glm::dvec3 direction((place.x / view.width * 2 - 1) * tanX, (1 - place.y / view.height * 2) * tanY, -1);
    const glm::dvec3 world = glm::dmat3(view.worldFromCamera) * direction;
    const auto hit = firstHit(seen.scene, seen.pose, glm::dvec3(view.worldFromCamera[3]), world);
    if (!hit || !(hit->distance > 0)) return {};
    return glm::normalize(direction) * hit->distance;
}

glm::dvec3 surfaceAtPixel(const Seen& seen, const Lens& lens, const glm::ivec2& pixel, const char* option) {
    const View& view = seen.view;
    if (pixel.x >= view.width || pixel.y >= view.height)
        fail("{}: pixel {},{} lies outside the image of {}x{}", option, pixel.x, pixel.y, view.width, view.height);
    const auto point = surfaceAt(seen, lens, glm::dvec2(pixel) + 0.5);
    if (!point)
        fail("{}: there is no surface at pixel {},{}; choose one that shows an object", option, pixel.x, pixel.y);
    return *point;
}

// With focus breathing the pixel's ray depends on the focus: a few rounds settle it.
double depthAtPixel(const Seen& seen, const glm::ivec2& pixel) {
    Lens lens = seen.view.lens;
    lens.focusDistance = std::numeric_limits<double>::infinity();
    const int rounds = lens.focusBreathing ? 4 : 1;
    for (int i = 0; i < rounds; ++i) {
        lens.focusDistance = -surfaceAtPixel(seen, lens, pixel, "--focus-pixel").z;
        checkLens(lens);
    }
    return lens.focusDistance;
}

// The median depth of what the image's central third shows.
double depthOfMiddle(const Seen& seen) {
    Lens lens = seen.view.lens;
    lens.focusDistance = std::numeric_limits<double>::infinity();
    const glm::dvec2 size(seen.view.width, seen.view.height);
    std::vector<double> depths;
    for (int y = 0; y < autoPoints; ++y)
        for (int x = 0; x < autoPoints; ++x) {
            const glm::dvec2 part = (glm::dvec2(x, y) + 0.5) / static_cast<double>(autoPoints);
            if (const auto point = surfaceAt(seen, lens, size * (1.0 + part) / 3.0)) depths.push_back(-point->z);
        }
    if (depths.empty()) fail("--focus-auto: the middle of the image shows no surface; choose another way to focus");
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    return *middle;
}

// The plane through three points: w + mx·X + my·Y = s for (X, Y, −w) in view space, mx = tan(swing), my = tan(tilt).
void focusAlong(const Seen& seen, const std::array<glm::ivec2, 3>& pixels, Lens& lens) {
    Lens flat = lens;
    flat.focusDistance = std::numeric_limits<double>::infinity();
    glm::dvec3 points[3];
    for (std::size_t i = 0; i < 3; ++i) points[i] = surfaceAtPixel(seen, flat, pixels[i], "--focus-points");
    const glm::dvec3 normal = glm::cross(points[1] - points[0], points[2] - points[0]);
    const double extent = glm::length(points[1] - points[0]) * glm::length(points[2] - points[0]);
    if (!(glm::length(normal) > 1e-6 * extent)) fail("--focus-points: the three points lie on a line; choose others");
    if (!(std::abs(normal.z) > 2e-3 * glm::length(normal)))
        fail("--focus-points: the plane through the three points holds the view axis; choose others");
    // normal·(X, Y, −w) = normal·point; divided by −normal.z.
    lens.focusSwing = std::atan(-normal.x / normal.z);
    lens.focusTilt = std::atan(-normal.y / normal.z);
    lens.focusDistance = -glm::dot(normal, points[0]) / normal.z;
    if (!(lens.focusDistance > 0))
        fail(
            "--focus-points: the plane through the three points meets the view axis at or behind the camera; choose "
            "others");
}

}  // namespace

void chooseFocus(const SceneOptions& options, const Camera& camera, const Scene& scene, const Pose& pose, View& view) {
    const Seen seen{scene, pose, view};
    Lens& lens = view.lens;
    const auto distance = options.lens.find("focusDistance");
    const std::optional<double> own = camera.lensValue("focusDistance");
    if (distance != options.lens.end())
        lens.focusDistance = distance->second;
    else if (!options.focusNode.empty())
        lens.focusDistance = depthOfNode(seen, options.focusNode);
    else if (options.focusPixel)
        lens.focusDistance = depthAtPixel(seen, *options.focusPixel);
    else if (options.focusPoints)
        focusAlong(seen, *options.focusPoints, lens);
    else if (options.focusAuto)
        lens.focusDistance = depthOfMiddle(seen);
    else
        lens.focusDistance = own && *own > 0 ? *own : depthOfCentre(seen);
}

}  // namespace defocus
