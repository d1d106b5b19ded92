#include "view/state/camera_controls.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace defocus::engine {

namespace {

const glm::dvec3 worldUp(0, 1, 0);
constexpr double maxElevation = glm::radians(89.0);
constexpr double minPivotDistance = 1e-4;  // min distance of the pivot from the camera, m
constexpr double maxPivotDistance = 1e7;

// Orthonormalizes the axes, so that rounding errors of many small rotations don't accumulate.
glm::dmat4 rigid(const glm::dmat4& matrix) {
    const glm::dvec3 z = glm::normalize(glm::dvec3(matrix[2]));
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(matrix[1]), z));
    return {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), matrix[3]};
}

ViewCamera turnedAbout(const ViewCamera& camera, const glm::dvec3& centre, double right, double up) {
    const double elevation = std::asin(std::clamp(camera.forward().y, -1.0, 1.0));
    const double lowest = std::min(-maxElevation, elevation);
    const double highest = std::max(maxElevation, elevation);
    const double pitch = std::clamp(elevation + up, lowest, highest) - elevation;

    // Rotate about the horizontal axis perpendicular to the view direction. The camera's own x axis isn't horizontal if
    // the camera is rolled.
    const glm::dvec3 across = glm::cross(camera.forward(), worldUp);
    const glm::dvec3 axis = glm::length(across) > 1e-6 ? glm::normalize(across) : glm::dvec3(camera.worldFromCamera[0]);
    const glm::dquat rotation = glm::angleAxis(right, worldUp) * glm::angleAxis(pitch, axis);
    const glm::dmat4 about =
        glm::translate(glm::dmat4(1.0), centre) * glm::mat4_cast(rotation) * glm::translate(glm::dmat4(1.0), -centre);
    return {rigid(about * camera.worldFromCamera), camera.pivotDistance};
}

ViewCamera moved(const ViewCamera& camera, const glm::dvec3& offset) {
    ViewCamera result = camera;
    result.worldFromCamera[3] += glm::dvec4(offset, 0);
    return result;
}

}  // namespace

ViewCamera orbited(const ViewCamera& camera, double right, double up) {
    return turnedAbout(camera, camera.pivot(), right, up);
}

ViewCamera turned(const ViewCamera& camera, double right, double up) {
    return turnedAbout(camera, camera.position(), right, up);
}

ViewCamera panned(const ViewCamera& camera, double right, double up) {
    return moved(camera, right * glm::dvec3(camera.worldFromCamera[0]) + up * glm::dvec3(camera.worldFromCamera[1]));
}

ViewCamera zoomed(const ViewCamera& camera, double factor) {
    const double distance = std::clamp(camera.pivotDistance * factor, minPivotDistance, maxPivotDistance);
    ViewCamera result = moved(camera, (camera.pivotDistance - distance) * camera.forward());
    result.pivotDistance = distance;
    return result;
}

ViewCamera flown(const ViewCamera& camera, const glm::dvec3& rightUpAhead) {
    return moved(camera, rightUpAhead.x * glm::dvec3(camera.worldFromCamera[0]) + rightUpAhead.y * worldUp +
                             rightUpAhead.z * camera.forward());
}

ViewCamera framed(const ViewCamera& camera, const Bounds& bounds, double tanHalfHorizontal, double tanHalfVertical) {
    if (bounds.empty()) return camera;
    const double radius = std::max(0.5 * glm::length(bounds.size()), 1e-6);
    const double narrower = std::atan(std::min(tanHalfHorizontal, tanHalfVertical));
    ViewCamera result = camera;
    result.pivotDistance = std::clamp(radius / std::sin(narrower), minPivotDistance, maxPivotDistance);
    result.worldFromCamera[3] = glm::dvec4(bounds.centre() - result.pivotDistance * camera.forward(), 1);
    return result;
}

glm::dvec3 rayThrough(const ViewCamera& camera, const glm::dvec2& point, double tanHalfHorizontal,
                      double tanHalfVertical) {
    return glm::dmat3(camera.worldFromCamera) *
           glm::dvec3(point.x * tanHalfHorizontal, point.y * tanHalfVertical, -1.0);
}

}  // namespace defocus::engine
