#pragma once
// The vertices of a level in clip space, on the CPU: as shaders/include/posing.glsl and lens.glsl make them on the GPU.

#include <glm/vec3.hpp>
#include <vector>

#include "plan/frame_plan.h"

namespace defocus::engine {

struct ClipVertices {
    std::vector<glm::dvec3> places;  // (x, y, w) of the pinhole image
    std::vector<double> coc;         // C of each; it has no meaning where w ≤ 0 and the lens has controls
};

// `pose` is one of the object's; `time`, from 0 to 1, is that of the exposure.
ClipVertices clipVertices(const FramePlan& plan, const World& world, const ObjectPlan& object, std::uint32_t level,
                          const ObjectPose& pose, double time);

}  // namespace defocus::engine
