#pragma once
// Estimates where the surfaces are that the image shows, from the objects' bounding boxes.

#include <glm/vec3.hpp>
#include <vector>

#include "plan/frame_plan.h"

namespace defocus::engine {

// A visible surface passes through or near `place`, up to `spread` m away.
struct SeenPoint {
    glm::dvec3 place{0.0};  // m from the camera along the world's axes
    double depth = 0;       // m along the view axis
    double spread = 0;
    double blur = 0;  // px, CoC diameter
};

// Returns points in the bounding boxes that rays through a coarse grid of pixels meet, for each ray that meets one. If
// no ray does, the only entry has the middles of all boxes.
std::vector<std::vector<SeenPoint>> seenPoints(const FramePlan& plan);

}  // namespace defocus::engine
