#include "eval/convergence/unlit_scene.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "image/tone_map.h"

namespace defocus::engine {

namespace {

const glm::vec3 towardsLight = glm::normalize(glm::vec3(0.4f, 0.8f, 0.6f));  // direction in object space
constexpr float ambient = 0.2f;

// Returns the mean linear colour of the image; white for an image without pixels.
glm::vec3 meanColour(const TextureImage& image) {
    glm::dvec3 sum(0);
    const std::size_t count = image.rgba.size() / 4;
    for (std::size_t i = 0; i < count; ++i)
        for (glm::length_t c = 0; c < 3; ++c)
            sum[c] += srgbDecode(static_cast<float>(image.rgba[4 * i + static_cast<std::size_t>(c)]) / 255);
    return count == 0 ? glm::vec3(1) : glm::vec3(sum / static_cast<double>(count));
}

Material unlitMaterial(const Material& material, const Scene& scene) {
    Material unlit;
    unlit.name = material.name;
    unlit.doubleSided = material.doubleSided;
    unlit.unlit = true;
    unlit.baseColorFactor = glm::vec4(glm::vec3(material.baseColorFactor), 1);
    if (!material.baseColor.used()) return unlit;
    const int image = scene.textures[static_cast<std::size_t>(material.baseColor.texture)].image;
    if (image >= 0) unlit.baseColorFactor *= glm::vec4(meanColour(scene.images[static_cast<std::size_t>(image)]), 1);
    return unlit;
}

void paintLight(Mesh& mesh) {
    Vertices& vertices = mesh.vertices;
    if (vertices.normals.empty()) {
        std::vector<std::uint32_t> indices;
        for (const Primitive& primitive : mesh.primitives)
            indices.insert(indices.end(), primitive.indices.begin(), primitive.indices.end());
        vertices.normals = smoothNormals(vertices.positions, indices);
    }
    vertices.colors.resize(vertices.count(), glm::vec4(1));
    for (std::size_t i = 0; i < vertices.count(); ++i) {
        const float light = ambient + (1 - ambient) * std::max(0.0f, glm::dot(vertices.normals[i], towardsLight));
        vertices.colors[i] = glm::vec4(light * glm::vec3(vertices.colors[i]), 1);
    }
}

}  // namespace

Scene unlitScene(Scene scene) {
    for (Material& material : scene.materials) material = unlitMaterial(material, scene);
    // Give an unlit material to primitives that have no material, because glTF's default material is lit.
    Material plain;
    plain.unlit = true;
    scene.materials.push_back(std::move(plain));
    for (Mesh& mesh : scene.meshes) {
        paintLight(mesh);
        for (Primitive& primitive : mesh.primitives)
            if (primitive.material < 0) primitive.material = static_cast<int>(scene.materials.size()) - 1;
    }
    scene.textures.clear();
    scene.images.clear();
    scene.imageNames.clear();
    return scene;
}

}  // namespace defocus::engine
