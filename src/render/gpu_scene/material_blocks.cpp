#include "render/gpu_scene/material_blocks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <utility>

namespace defocus::engine {

namespace {

constexpr GLuint materialBinding = 2;  // uniform block in shaders/include/frame.glsl
constexpr GLuint uvRowsBinding = 8;    // uniform block in shaders/include/material_textures.glsl

constexpr float minAttenuation = 1e-6f;  // lower bound of a colour channel before its logarithm

GpuMaterial blockOf(const Material& material, double metresPerUnit) {
    GpuMaterial block{};
    block.baseColor = material.baseColorFactor;
    block.emissiveCutoff = glm::vec4(material.emissiveFactor, material.alphaCutoff);
    block.surface = {material.metallicFactor, material.roughnessFactor, material.normalScale,
                     material.occlusionStrength};
    // Reflectance of a dielectric with index of refraction n at normal incidence: ((n − 1)/(n + 1))². n = 0 stands for
    // infinity.
    const float ior = material.ior;
    const float normalIncidence = ior > 0 ? (ior - 1) * (ior - 1) / ((ior + 1) * (ior + 1)) : 1.0f;
    block.reflectance = glm::vec4(normalIncidence * material.specularColorFactor, material.specularFactor);
    // transmission.w is the factor on the blur of the background by roughness: 0 for refractive index 1 (air), 1 for
    // 1.5 and above.
    block.transmission = {material.transmissionFactor, material.thicknessFactor, ior > 0 ? 1 / ior : 0.0f,
                          ior > 0 ? glm::clamp(2 * ior - 2, 0.0f, 1.0f) : 1.0f};
    const double distance = material.attenuationDistance * metresPerUnit;
    block.absorption =
        glm::vec4(-glm::log(glm::max(material.attenuationColor, minAttenuation)) / static_cast<float>(distance),
                  material.dispersion);
    block.coat = {material.clearcoatFactor, material.clearcoatRoughnessFactor, material.clearcoatNormalScale, 0};
    block.sheen = glm::vec4(material.sheenColorFactor, material.sheenRoughnessFactor);
    block.anisotropy = {material.anisotropyStrength, std::cos(material.anisotropyRotation),
                        std::sin(material.anisotropyRotation), 0};
    block.film = {material.iridescenceFactor, material.iridescenceIor, material.iridescenceThicknessMinimum,
                  material.iridescenceThicknessMaximum};
    block.through = glm::vec4(material.diffuseTransmissionColorFactor, material.diffuseTransmissionFactor);
    return block;
}

GpuUvRows uvRowsOf(const Material& material) {
    GpuUvRows rows{};
    const auto uses = textureUses(material);
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const glm::mat3& m = uses[i]->uvTransform;
        rows[2 * i] = {m[0][0], m[1][0], m[2][0], static_cast<float>(uses[i]->uvSet)};
        rows[2 * i + 1] = {m[0][1], m[1][1], m[2][1], 0};
    }
    return rows;
}

bool transformsAnyUv(const Material& material) {
    return std::ranges::any_of(textureUses(material), [](const TextureUse* use) { return transformsUv(*use); });
}

}  // namespace

bool transformsUv(const TextureUse& use) {
    return use.used() && (use.uvSet != 0 || use.uvTransform != glm::mat3(1.0f));
}

MaterialBlocks::MaterialBlocks(const GpuScene& scene, std::vector<int> materials)
    : scene_(&scene), materials_(std::move(materials)), uvSlots_(materials_.size()) {
    const double metresPerUnit = scene.world().scene->metresPerUnit;
    blocks_ = UniformBlocks<GpuMaterial>(
        materials_.size(), [&](std::size_t slot) { return blockOf(scene.material(materials_[slot]), metresPerUnit); });
    std::vector<int> transformed;
    for (std::size_t slot = 0; slot < materials_.size(); ++slot) {
        if (!transformsAnyUv(scene.material(materials_[slot]))) continue;
        uvSlots_[slot] = transformed.size();
        transformed.push_back(materials_[slot]);
    }
    uvRows_ = UniformBlocks<GpuUvRows>(transformed.size(),
                                       [&](std::size_t i) { return uvRowsOf(scene.material(transformed[i])); });
}

void MaterialBlocks::bind(std::size_t slot) const {
    blocks_.bind(materialBinding, slot);
    if (uvSlots_[slot]) uvRows_.bind(uvRowsBinding, *uvSlots_[slot]);
    scene_->textures(materials_[slot]).attach();
}

}  // namespace defocus::engine
