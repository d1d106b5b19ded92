#pragma once
// Functions shared by all passes that draw the surfaces of a FramePlan: uniforms and poses of objects, index
// ranges of visible clusters, and shader defines of a material.

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <vector>

#include "render/gpu_scene/frame_uniforms.h"
#include "render/gpu_scene/gpu_poses.h"
#include "render/gpu_scene/gpu_scene.h"

namespace defocus::engine {

// Uniforms of an object; matches shaders/include/frame.glsl.
struct GpuObject {
    glm::mat4 viewFromObject;
    glm::mat3 normalMatrix;
    glm::vec4 values;
    glm::ivec4 posing;
    glm::vec2 levels;
};

// Returns the uniforms of each object of the plan. `scene` must hold the meshes of these objects. Sets `poses` to one
// entry per object.
std::vector<GpuObject> objectUniforms(const FramePlan& plan, const GpuScene& scene, std::vector<GpuPoses>& poses);
// Sets the uniforms of an object in the current program.
void setObject(const GpuObject& object);

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
    caster,       // for shadow maps: like `flat`, but transmitting surfaces output the fraction of light let through
    lit,          // full shading; transmitting surfaces are drawn as if they were opaque
    seenThrough,  // like `lit`, but the background is visible through transmitting surfaces
};

// Returns the defines of shaders/include/surface_shading.glsl and material_textures.glsl for a material on a mesh.
ShaderDefines surfaceDefines(const GpuScene& scene, const GpuMesh& mesh, int material, std::uint32_t level,
                             SurfaceLook look);

// Returns a string that is unique for each list of defines.
std::string keyOf(const ShaderDefines& defines);

}  // namespace defocus::engine
