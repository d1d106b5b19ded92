#pragma once
// Converts the poses of an object to the layout of shaders/include/posing.glsl.

#include <glm/vec4.hpp>

#include "gl/program.h"
#include "gl/texel_buffer.h"
#include "plan/frame_plan.h"
#include "render/gpu_scene/gpu_scene.h"

namespace defocus::engine {

struct GpuPoses {
    TexelBuffer texels;  // RGBA32F; empty if the object has a single matrix
    // Numbers of texels per pose, of joints, of active morph targets, and of texels per attribute of a morph target;
    // see Object::posing in shaders/include/frame.glsl.
    glm::ivec4 layout{0};
    std::size_t count = 1;  // number of poses
    bool skinned = false;
    bool moving = false;
    bool cameraMoves = false;
};

// Returns the poses of object `object` of `plan`; `mesh` is the object's mesh.
GpuPoses gpuPoses(const FramePlan& plan, const ObjectPlan& object, const GpuMesh& mesh);

// Adds the defines that the vertex shader needs for an object with these poses.
void poseDefines(ShaderDefines& defines, const GpuPoses& poses, const GpuMesh& mesh);

}  // namespace defocus::engine
