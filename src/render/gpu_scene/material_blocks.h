#pragma once
// Uniform blocks of materials. The transforms of texture coordinates have a block of their own, because they are larger
// than all other values and few materials have them.

#include <array>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "render/gpu_scene/gpu_scene.h"
#include "render/gpu_scene/uniform_blocks.h"

namespace defocus::engine {

// Uniform block of a material; matches shaders/include/frame.glsl (std140).
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

// Transforms of a material's texture coordinates; matches shaders/include/material_textures.glsl (std140).
using GpuUvRows = std::array<glm::vec4, 2 * materialTextureCount>;

// Returns whether a texture is read at other coordinates than those of UV set 0.
bool transformsUv(const TextureUse& use);

class MaterialBlocks {
public:
    MaterialBlocks() = default;
    // Uploads the blocks of `materials`, which are indices of the scene's materials; −1 is the default material.
    MaterialBlocks(const GpuScene& scene, std::vector<int> materials);

    // Binds the blocks and the textures of the material with index `slot` in the list.
    void bind(std::size_t slot) const;
    [[nodiscard]] std::size_t bytes() const { return blocks_.bytes() + uvRows_.bytes(); }

private:
    const GpuScene* scene_ = nullptr;
    std::vector<int> materials_;
    UniformBlocks<GpuMaterial> blocks_;
    UniformBlocks<GpuUvRows> uvRows_;
    std::vector<std::optional<std::size_t>> uvSlots_;  // per material: index in uvRows_; nullopt without transforms
};

}  // namespace defocus::engine
