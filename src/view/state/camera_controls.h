#pragma once
// Moves a camera: orbit, pan, zoom, fly and frame, as pure functions that return the moved camera. World up is +y. A
// camera keeps its roll.

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/bounds.h"

namespace defocus::engine {

struct ViewCamera {
    glm::dmat4 worldFromCamera{1.0};  // rigid transform; the camera looks along −z
    double pivotDistance = 1;         // distance of the pivot in m, > 0; orbit and zoom are about the pivot

    [[nodiscard]] glm::dvec3 position() const { return worldFromCamera[3]; }
    [[nodiscard]] glm::dvec3 forward() const { return -glm::dvec3(worldFromCamera[2]); }
    [[nodiscard]] glm::dvec3 pivot() const { return position() + pivotDistance * forward(); }
};

// Rotates the camera around its pivot: by `right` radians about world up, by `up` radians about the horizontal axis
// perpendicular to the view. The elevation is clamped short of straight up and straight down.
ViewCamera orbited(const ViewCamera& camera, double right, double up);

// Rotates the camera about its own position. `right` and `up`: see orbited().
ViewCamera turned(const ViewCamera& camera, double right, double up);

// Moves the camera and its pivot parallel to the image, in metres along the camera's right and up axes.
ViewCamera panned(const ViewCamera& camera, double right, double up);

// Multiplies the distance to the pivot by `factor`; < 1 moves the camera closer.
ViewCamera zoomed(const ViewCamera& camera, double factor);

// Moves the camera and its pivot by `rightUpAhead`, in m: x along the camera's right axis, y along the world's up axis,
// z along the viewing direction.
ViewCamera flown(const ViewCamera& camera, const glm::dvec3& rightUpAhead);

// Moves the camera, without rotating it, so that the bounding sphere of `bounds` fills the image; the sphere's centre
// becomes the pivot. Returns the camera unchanged for empty bounds.
ViewCamera framed(const ViewCamera& camera, const Bounds& bounds, double tanHalfHorizontal, double tanHalfVertical);

// Returns the direction of the ray through a point of the image, x and y in [−1, 1], y up. The direction's component
// along the view axis is 1.
glm::dvec3 rayThrough(const ViewCamera& camera, const glm::dvec2& point, double tanHalfHorizontal,
                      double tanHalfVertical);

}  // namespace defocus::engine
