#pragma once
// Moves a camera: orbit, pan, zoom, fly and frame, as pure functions from one camera to the next. The world's up
// direction is +y. A camera keeps its roll.

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/bounds.h"

namespace defocus::engine {

struct ViewCamera {
    glm::dmat4 worldFromCamera{1.0};  // rigid; the camera looks along its −z axis
    double pivotDistance = 1;         // m ahead, > 0; the camera orbits around the pivot and zooms to it

    [[nodiscard]] glm::dvec3 position() const { return worldFromCamera[3]; }
    [[nodiscard]] glm::dvec3 forward() const { return -glm::dvec3(worldFromCamera[2]); }
    [[nodiscard]] glm::dvec3 pivot() const { return position() + pivotDistance * forward(); }
};

// Turns the camera around its pivot: `right` radians about the world's up direction, `up` radians about the camera's
// horizontal axis. The elevation is clamped short of straight up and straight down.
ViewCamera orbited(const ViewCamera& camera, double right, double up);

// Makes the same turn around the camera's own position.
ViewCamera turned(const ViewCamera& camera, double right, double up);

// Moves the camera and its pivot sideways, in metres along the camera's own axes.
ViewCamera panned(const ViewCamera& camera, double right, double up);

// Multiplies the distance to the pivot by `factor`; below 1 the camera comes nearer.
ViewCamera zoomed(const ViewCamera& camera, double factor);

// Moves the camera and its pivot in metres to the right, along the world's up direction, and ahead.
ViewCamera flown(const ViewCamera& camera, const glm::dvec3& rightUpAhead);

// Keeps the direction and moves the camera so that the sphere around `bounds` fills the image; its centre becomes the
// pivot. Returns the same camera for empty bounds.
ViewCamera framed(const ViewCamera& camera, const Bounds& bounds, double tanHalfHorizontal, double tanHalfVertical);

// Returns the direction of the ray through a point of the image; x and y in [−1, 1], y up. Its component along the
// view axis is 1.
glm::dvec3 rayThrough(const ViewCamera& camera, const glm::dvec2& point, double tanHalfHorizontal,
                      double tanHalfVertical);

}  // namespace defocus::engine
