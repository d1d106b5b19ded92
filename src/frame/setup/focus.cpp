#include "frame/setup/focus.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "core/error.h"
#include "plan/visible/focus_depth.h"

namespace defocus::engine {

namespace {

constexpr double defaultFocusDistance = 2.5;  // m; used if the scene's centre is beside or behind the camera

double depthOfCentre(const Bounds& bounds, const View& view) {
    const double depth = bounds.empty() ? 0 : -(glm::inverse(view.worldFromCamera) * glm::dvec4(bounds.centre(), 1)).z;
    return depth > view.nearPlane && std::isfinite(depth) ? depth : defaultFocusDistance;
}

// Returns the median depth (m) of the surfaces near the image's centre; if there are none, the depth of the scene's
// centre.
double depthOfSubject(const Scene& scene, const Pose& pose, const View& view) {
    const std::optional<double> depth = depthOfMiddle(scene, pose, view);
    return depth && *depth > view.nearPlane && std::isfinite(*depth) ? *depth : depthOfCentre(pose.bounds, view);
}

void focusAlong(const Scene& scene, const Pose& pose, const std::vector<Pixel>& pixels, View& view) {
    Lens flat = view.lens;
    flat.focusDistance = std::numeric_limits<double>::infinity();
    std::vector<glm::dvec3> points;
    for (const Pixel& pixel : pixels)
        points.push_back(surfaceAtPixel(scene, pose, view, flat, asVector(pixel), "--focus-points"));
    focusThrough(points, view.lens, "--focus-points");
}

// Fits a plane of focus: solves w + mx·X + my·Y = s for three points (X, Y, −w) in view space, with focus distance s,
// mx = tan(swing) and my = tan(tilt).
void planeThrough(std::span<const glm::dvec3, 3> points, Lens& lens, const std::string& what) {
    const glm::dvec3 normal = glm::cross(points[1] - points[0], points[2] - points[0]);
    const double extent = glm::length(points[1] - points[0]) * glm::length(points[2] - points[0]);
    if (!(glm::length(normal) > 1e-6 * extent)) fail("{}: the three points are on a line; choose other points", what);
    if (!(std::abs(normal.z) > 2e-3 * glm::length(normal)))
        fail("{}: the plane through the three points contains the view axis; choose other points", what);
    const double distance = -glm::dot(normal, points[0]) / normal.z;
    if (!(distance > 0))
        fail(
            "{}: the plane through the three points crosses the view axis at or behind the camera; choose other points",
            what);
    // Dividing the plane equation normal·(X, Y, −w) = normal·points[0] by −normal.z gives w + mx·X + my·Y = s.
    lens.focusSwing = std::atan(-normal.x / normal.z);
    lens.focusTilt = std::atan(-normal.y / normal.z);
    lens.focusDistance = distance;
}

// Fits a curved surface of focus to points (X, Y, −w) in view space by least squares: 1/w = 1/s + mx/s·X/w + my/s·Y/w +
// κ/s·r², with s, mx and my as in planeThrough. r is the distance from the image's centre in units of half the image
// width, κ the field curvature. A small term on the diagonal of the normal equations sets undetermined unknowns to 0.
void surfaceNear(std::span<const glm::dvec3> points, Lens& lens, const std::string& what) {
    constexpr double raised = 1e-12;  // regularization: added to the diagonal of the normal equations, once per point
    const double tanX = tanHalfHorizontalFov(lens);
    glm::dmat4 matrix(raised * static_cast<double>(points.size()));
    glm::dvec4 right(0);
    for (const glm::dvec3& point : points) {
        const glm::dvec2 field = glm::dvec2(point) / (-point.z * tanX);
        const glm::dvec4 terms(1, field, glm::dot(field, field));
        matrix += glm::outerProduct(terms, terms);
        right += terms * (-1 / point.z);
    }
    const glm::dvec4 fitted = glm::inverse(matrix) * right;
    if (!(fitted[0] > 0))
        fail("{}: the focus surface through these points crosses the view axis behind the camera; choose other points",
             what);
    Lens focused = lens;
    focused.focusDistance = 1 / fitted[0];
    focused.focusSwing = std::atan(fitted[1] / (fitted[0] * tanX));
    focused.focusTilt = std::atan(fitted[2] / (fitted[0] * tanX));
    focused.fieldCurvature = fitted[3] / fitted[0];
    checkLens(focused);
    lens = focused;
}

}  // namespace

void focusThrough(std::span<const glm::dvec3> points, Lens& lens, const std::string& what) {
    if (points.size() == 3)
        planeThrough(points.first<3>(), lens, what);
    else
        surfaceNear(points, lens, what);
}

void chooseFocus(const Request& request, const Camera& camera, const Scene& scene, const Pose& pose, View& view) {
    Lens& lens = view.lens;
    const std::optional<double> own = camera.lensValue("focusDistance");
    const Focus& focus = request.focus;
    if (const auto* const distance = std::get_if<FocusDistance>(&focus))
        lens.focusDistance = distance->metres;
    else if (const auto* const node = std::get_if<FocusNode>(&focus))
        lens.focusDistance = depthOfNode(scene, pose, view, node->name, "--focus-node");
    else if (const auto* const at = std::get_if<FocusPixel>(&focus))
        lens.focusDistance = depthAtPixel(scene, pose, view, asVector(at->pixel), "--focus-pixel");
    else if (const auto* const points = std::get_if<FocusPoints>(&focus))
        focusAlong(scene, pose, points->pixels, view);
    else if (std::holds_alternative<FocusAuto>(focus))
        lens.focusDistance = depthOfMiddle(scene, pose, view, "--focus-auto");
    else
        lens.focusDistance = own && *own > 0 ? *own : depthOfSubject(scene, pose, view);
}

}  // namespace defocus::engine
