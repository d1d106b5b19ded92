#pragma once
// Bakes lighting into the colours of a scene, so that two renderers must give the same colours. Every material becomes
// unlit and opaque, and textures are dropped. Lambert shading from one fixed direction goes into vertex colours, which
// both renderers interpolate linearly. Remaining differences come from geometry, visibility, projection and the lens.

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "scene/scene.h"

namespace defocus::engine {

// Returns the colour of a material. Textured materials get different colours from a palette, so that the parts of the
// scene remain distinguishable without textures.
inline glm::vec4 bakedColor(const Material& material, std::size_t index) {
    constexpr std::array<glm::vec3, 6> palette = {glm::vec3(0.80f, 0.35f, 0.20f), glm::vec3(0.25f, 0.55f, 0.75f),
                                                  glm::vec3(0.70f, 0.65f, 0.25f), glm::vec3(0.35f, 0.65f, 0.35f),
                                                  glm::vec3(0.65f, 0.40f, 0.65f), glm::vec3(0.75f, 0.75f, 0.75f)};
    const glm::vec3 factor(material.baseColorFactor);
    return glm::vec4(material.baseColor.used() ? factor * palette[index % palette.size()] : factor, 1.0f);
}

inline void bakeLighting(Mesh& mesh) {
    const glm::vec3 towardsLight = glm::normalize(glm::vec3(0.4f, 0.8f, 0.6f));  // in object space
    if (mesh.vertices.normals.empty()) {
        std::vector<std::uint32_t> indices;
        for (const Primitive& primitive : mesh.primitives) {
            indices.insert(indices.end(), primitive.indices.begin(), primitive.indices.end());
        }
        mesh.vertices.normals = smoothNormals(mesh.vertices.positions, indices);
    }
    mesh.vertices.colors.resize(mesh.vertices.count(), glm::vec4(1));
    for (std::size_t i = 0; i < mesh.vertices.count(); ++i) {
        const float lit = 0.2f + 0.8f * std::max(0.0f, glm::dot(mesh.vertices.normals[i], towardsLight));
        mesh.vertices.colors[i] = glm::vec4(lit * glm::vec3(mesh.vertices.colors[i]), 1.0f);
    }
}

inline Scene bakedUnlit(Scene scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material baked{.name = scene.materials[i].name,
                       .baseColorFactor = bakedColor(scene.materials[i], i),
                       .doubleSided = scene.materials[i].doubleSided,
                       .unlit = true};
        scene.materials[i] = std::move(baked);
    }
    // Primitives without a material get an unlit material, since glTF's default material is lit.
    Material plain{.name = "baked default", .unlit = true};
    scene.materials.push_back(std::move(plain));
    for (Mesh& mesh : scene.meshes) {
        bakeLighting(mesh);
        for (Primitive& primitive : mesh.primitives) {
            if (primitive.material < 0) primitive.material = static_cast<int>(scene.materials.size()) - 1;
        }
    }
    scene.textures.clear();
    scene.images.clear();
    scene.imageNames.clear();
    return scene;
}

}  // namespace defocus::engine
