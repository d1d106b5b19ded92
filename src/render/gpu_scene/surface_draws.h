#pragma once
// What passes over the surfaces of a FramePlan share: the objects' uniform blocks and poses, the runs of indices that
// remain of a level, and the features that a material's shaders need.

#include <glm/mat4x4.hpp>
#include <vector>

#include "render/gpu_scene/frame_uniforms.h"
#include "render/gpu_scene/gpu_poses.h"
#include "render/gpu_scene/gpu_scene.h"
#include "render/gpu_scene/uniform_blocks.h"

namespace defocus::engine {

// An object's uniform block of shaders/include/frame.glsl, std140.
struct GpuObject {
    glm::mat4 viewFromObject;
    glm::mat4 normalMatrix;
    glm::vec4 values;
    glm::ivec4 posing;
    glm::vec4 levels;
};

// One for each object of the plan, whose meshes `scene` holds; `poses` as many.
UniformBlocks<GpuObject> objectBlocks(const FramePlan& plan, GpuScene& scene, std::vector<GpuPoses>& poses);

// A run of indices in GpuMesh::indices.
struct IndexRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

// What the frame draws of a primitive at a level: all of it, or what visible clusters leave.
std::vector<IndexRun> indexRuns(const World& world, const ObjectPlan& object, const GpuMesh& mesh, std::uint32_t level,
                                std::uint32_t primitive);

enum class SurfaceLook {
    flat,         // neither lights nor textures beyond the alpha test
    caster,       // as `flat`, and what lets light pass says how much
    lit,          // what transmits is opaque
    seenThrough,  // as `lit`, and what transmits shows what lies behind
};

// The features of a material on a mesh that shaders/include/surface_shading.glsl knows.
ShaderDefines surfaceDefines(const GpuScene& scene, const GpuMesh& mesh, int material, std::uint32_t level,
                             SurfaceLook look);

// One text for each set of defines.
std::string keyOf(const ShaderDefines& defines);

}  // namespace defocus::engine
