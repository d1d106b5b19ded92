#pragma once
// The pose of an object as shaders/include/posing.glsl reads it.

#include <glm/vec4.hpp>

#include "gl/program.h"
#include "gl/texel_buffer.h"
#include "plan/frame_plan.h"
#include "render/gpu_scene/gpu_scene.h"

namespace defocus::engine {

struct GpuPoses {
    TexelBuffer texels;    // RGBA32F; empty for an object whose one matrix says all
    glm::ivec4 layout{0};  // GpuObject::posing
    bool skinned = false;
    bool moving = false;
    bool cameraMoves = false;
};

// `plan` and `mesh` are the object's.
GpuPoses gpuPoses(const FramePlan& plan, const ObjectPlan& object, const GpuMesh& mesh);

// Adds what the vertex shader of an object in these poses needs.
void poseDefines(ShaderDefines& defines, const GpuPoses& poses, const GpuMesh& mesh);

}  // namespace defocus::engine
