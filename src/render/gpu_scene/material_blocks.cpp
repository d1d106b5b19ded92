#include "render/gpu_scene/material_blocks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <utility>

namespace defocus::engine {

namespace {

constexpr GLuint materialBinding = 2;  // binding of the material's block in shaders/include/frame.glsl

constexpr float minAttenuation = 1e-6f;  // lower bound of colour channels, so that their logarithms are finite

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
    // transmission.w scales the blur that roughness causes in the background: 0 for refractive index 1 (air), 1 for 1.5
    // and above.
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

GpuTransformedMaterial transformedBlockOf(const Material& material, double metresPerUnit) {
    GpuTransformedMaterial block{blockOf(material, metresPerUnit), {}};
    const auto uses = textureUses(material);
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const glm::mat3& m = uses[i]->uvTransform;
        block.uvRows[2 * i] = {m[0][0], m[1][0], m[2][0], static_cast<float>(uses[i]->uvSet)};
        block.uvRows[2 * i + 1] = {m[0][1], m[1][1], m[2][1], 0};
    }
    return block;
}

bool transformsAnyUv(const Material& material) {
    return std::ranges::any_of(textureUses(material), [](const TextureUse* use) { return transformsUv(*use); });
}

}  // namespace

std::size_t uniformStride(std::size_t bytes) {
    GLint alignment = 256;
    glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
    const auto step = static_cast<std::size_t>(alignment);
    return (bytes + step - 1) / step * step;
}

bool transformsUv(const TextureUse& use) {
    return use.used() && (use.uvSet != 0 || use.uvTransform != glm::mat3(1.0f));
}

MaterialBlocks::MaterialBlocks(const GpuScene& scene, std::vector<int> materials)
    : scene_(&scene), materials_(std::move(materials)) {
    const double metresPerUnit = scene.world().scene->metresPerUnit;
    std::vector<int> plain;
    std::vector<int> transformed;
    for (const int material : materials_) {
        const bool transforms = transformsAnyUv(scene.material(material));
        std::vector<int>& list = transforms ? transformed : plain;
        places_.push_back({transforms, list.size()});
        list.push_back(material);
    }
    plain_ = UniformBlocks<GpuMaterial>(
        plain.size(), [&](std::size_t i) { return blockOf(scene.material(plain[i]), metresPerUnit); });
    transformed_ = UniformBlocks<GpuTransformedMaterial>(transformed.size(), [&](std::size_t i) {
        return transformedBlockOf(scene.material(transformed[i]), metresPerUnit);
    });
}

void MaterialBlocks::bind(std::size_t slot) const {
    const Place place = places_[slot];
    if (place.transforms)
        transformed_.bind(materialBinding, place.block);
    else
        plain_.bind(materialBinding, place.block);
    scene_->textures(materials_[slot]).attach();
}

}  // namespace defocus::engine
