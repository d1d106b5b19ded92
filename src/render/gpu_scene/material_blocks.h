#pragma once
// Uploads the uniform blocks of materials. Transforms of texture coordinates are only in the blocks of materials that
// need them, because few materials do and the transforms are larger than all other values. The transforms are not in a
// block of their own: with the blocks of lights and shadows, a shader would then use more uniform blocks than Mesa
// 22.3's Vulkan driver (lavapipe) allows.

#include <array>
#include <glm/vec4.hpp>
#include <vector>

#include "render/gpu_scene/gpu_scene.h"
#include "render/gpu_scene/uniform_blocks.h"

namespace defocus::engine {

// Uniform block of a material; matches shaders/include/frame.glsl (std140) without UV_TRANSFORMS.
struct GpuMaterial {
    glm::vec4 baseColor;
    glm::vec4 emissiveCutoff;
    glm::vec4 surface;
    glm::vec4 reflectance;
    glm::vec4 transmission;
    glm::vec4 absorption;
    glm::vec4 coat;
    glm::vec4 sheen;
    glm::vec4 anisotropy;
    glm::vec4 film;
    glm::vec4 through;
};

// Uniform block of a material that transforms texture coordinates; matches shaders/include/frame.glsl (std140) with
// UV_TRANSFORMS.
struct GpuTransformedMaterial {
    GpuMaterial material;
    std::array<glm::vec4, 2 * materialTextureCount> uvRows;
};

// Returns whether a texture is read at transformed coordinates, or at coordinates of a UV set other than 0.
bool transformsUv(const TextureUse& use);

class MaterialBlocks {
public:
    MaterialBlocks() = default;
    // Uploads the blocks of `materials`, which are indices of the scene's materials; −1 is the default material.
    MaterialBlocks(const GpuScene& scene, std::vector<int> materials);

    // Binds the block and the textures of the material at index `slot` of the list of materials.
    void bind(std::size_t slot) const;
    [[nodiscard]] std::size_t bytes() const { return plain_.bytes() + transformed_.bytes(); }

private:
    const GpuScene* scene_ = nullptr;
    std::vector<int> materials_;
    struct Place {
        bool transforms = false;  // true: the block is in transformed_, else in plain_
        std::size_t block = 0;    // index of the block in transformed_ or plain_
    };
    UniformBlocks<GpuMaterial> plain_;
    UniformBlocks<GpuTransformedMaterial> transformed_;
    std::vector<Place> places_;  // for each material, where its uniform block is stored
};

}  // namespace defocus::engine
