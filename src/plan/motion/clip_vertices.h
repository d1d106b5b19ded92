#pragma once
// Computes the clip-space vertices of a level on the CPU. On the GPU, shaders/include/posing.glsl and lens.glsl compute
// the same vertices.

#include <glm/vec3.hpp>
#include <vector>

#include "plan/frame_plan.h"

namespace defocus::engine {

struct ClipVertices {
    std::vector<glm::dvec3> places;  // positions (x, y, w) in the clip space of the pinhole camera
    std::vector<double> coc;         // circle of confusion C; undefined for w ≤ 0 with artistic controls
};

// Returns the vertices of a level in `pose`, which is one of the object's poses. `time` ∈ [0, 1] is the time in the
// exposure.
ClipVertices clipVertices(const FramePlan& plan, const World& world, const ObjectPlan& object, std::uint32_t level,
                          const ObjectPose& pose, double time);

}  // namespace defocus::engine
