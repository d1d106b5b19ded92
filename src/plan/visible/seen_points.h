#pragma once
// Estimates the positions of the surfaces that are visible in the image, from the objects' bounding boxes.

#include <glm/vec3.hpp>
#include <vector>

#include "plan/frame_plan.h"

namespace defocus::engine {

// Estimated position of a visible surface: the surface passes `place` at a distance of at most `spread` m.
struct SeenPoint {
    glm::dvec3 place{0.0};  // position relative to the camera, in m, world axes
    double depth = 0;       // depth in m along the view axis
    double spread = 0;
    double blur = 0;  // CoC diameter, px
};

// Casts rays through a coarse grid of pixels and returns points inside the bounding boxes along each ray. Rays that
// meet no box are omitted. If all rays miss, the result is one entry with the centres of all boxes.
std::vector<std::vector<SeenPoint>> seenPoints(const FramePlan& plan);

}  // namespace defocus::engine
