#pragma once
// Functions shared by all passes that draw the surfaces of a FramePlan: uniform blocks and poses of objects, index
// ranges of visible clusters, and shader defines of a material.

#include <glm/mat4x4.hpp>
#include <vector>

#include "render/gpu_scene/frame_uniforms.h"
#include "render/gpu_scene/gpu_poses.h"
#include "render/gpu_scene/gpu_scene.h"
#include "render/gpu_scene/uniform_blocks.h"

namespace defocus::engine {

// Uniform block of an object; matches shaders/include/frame.glsl (std140).
struct GpuObject {
    glm::mat4 viewFromObject;
    glm::mat4 normalMatrix;
    glm::vec4 values;
    glm::ivec4 posing;
    glm::vec4 levels;
};

// Returns one uniform block per object of the plan, whose meshes `scene` must hold. Sets `poses` to one entry per
// object.
UniformBlocks<GpuObject> objectBlocks(const FramePlan& plan, const GpuScene& scene, std::vector<GpuPoses>& poses);

// Range of indices in MeshBuffers::indices.
struct IndexRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

// Returns the index ranges of a primitive at a level of detail: all indices, or the indices of the visible clusters.
std::vector<IndexRun> indexRuns(const World& world, const ObjectPlan& object, const GpuMesh& mesh, std::uint32_t level,
                                std::uint32_t primitive);

enum class SurfaceLook {
    flat,         // no lighting, and no textures except for the alpha test
    caster,       // like `flat`, and transmitting surfaces output the fraction of light that passes
    lit,          // full shading; transmitting surfaces are opaque
    seenThrough,  // like `lit`, but the background is visible through transmitting surfaces
};

// Returns the defines of shaders/include/surface_shading.glsl and material_textures.glsl for a material on a mesh.
ShaderDefines surfaceDefines(const GpuScene& scene, const GpuMesh& mesh, int material, std::uint32_t level,
                             SurfaceLook look);

// Returns a string that is unique for each list of defines.
std::string keyOf(const ShaderDefines& defines);

}  // namespace defocus::engine
