#pragma once
// How hands move a camera: orbit, pan, zoom, fly and frame, as pure functions from one camera to the next. The world's
// up is +y; a roll that a camera came with is kept.

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/bounds.h"

namespace defocus {

struct ViewCamera {
    glm::dmat4 worldFromCamera{1.0};  // rigid; looks along its −z
    double pivotDistance = 1;         // m ahead: what it orbits around and zooms to, > 0

    [[nodiscard]] glm::dvec3 position() const { return worldFromCamera[3]; }
    [[nodiscard]] glm::dvec3 forward() const { return -glm::dvec3(worldFromCamera[2]); }
    [[nodiscard]] glm::dvec3 pivot() const { return position() + pivotDistance * forward(); }
};

// Around the pivot: `right` radians about the world's up, `up` radians about the camera's horizontal axis. The view
// never tips over: it stops short of straight up and straight down.
ViewCamera orbited(const ViewCamera& camera, double right, double up);

// The same turn with the camera's position as the pivot: looking around.
ViewCamera turned(const ViewCamera& camera, double right, double up);

// Sideways, in metres along the camera's own axes; the pivot comes along.
ViewCamera panned(const ViewCamera& camera, double right, double up);

// Towards the pivot: its distance becomes `factor` times as large (< 1: nearer).
ViewCamera zoomed(const ViewCamera& camera, double factor);

// Metres to the right, upwards (the world's up) and ahead, the pivot coming along.
ViewCamera flown(const ViewCamera& camera, const glm::dvec3& rightUpAhead);

// From the same direction, so that the sphere around `bounds` fills the image; the pivot is its centre. Empty bounds
// leave the camera as it is.
ViewCamera framed(const ViewCamera& camera, const Bounds& bounds, double tanHalfHorizontal, double tanHalfVertical);

// Where the ray through a point of the image leads; x and y in [−1, 1], y up. Its component along the view axis is 1.
glm::dvec3 rayThrough(const ViewCamera& camera, const glm::dvec2& point, double tanHalfHorizontal,
                      double tanHalfVertical);

}  // namespace defocus
