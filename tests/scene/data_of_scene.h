#pragma once
// Converts a loaded scene to SceneData, so that tests can build the scene again from memory.

#include <algorithm>
#include <cstring>
#include <deque>
#include <glm/gtc/type_ptr.hpp>
#include <vector>

#include "defocus/scene_data.h"
#include "image/tone_map.h"
#include "scene/pose.h"

namespace defocus::engine {

// Holds the arrays of a scene's SceneData. Each mesh must have one primitive with texture coordinate set 0 and no
// texture transform. Animations, skins and the environment are omitted.
class DataOfScene {
public:
    explicit DataOfScene(const Scene& scene) : scene_(scene) {
        for (std::size_t i = 0; i < scene.textures.size(); ++i) addTexture(static_cast<int>(i));
        for (const Material& material : scene.materials) addMaterial(material);
        for (const Mesh& mesh : scene.meshes) addMesh(mesh);
        const Pose pose = poseAt(scene, 0, -1);
        for (std::size_t i = 0; i < scene.nodes.size(); ++i) addNode(scene.nodes[i], pose.worldFromNode[i]);
    }
    DataOfScene(const DataOfScene&) = delete;
    DataOfScene& operator=(const DataOfScene&) = delete;

    [[nodiscard]] SceneData data() const {
        return {scene_.name, meshes, materials, textures, instances, cameras, lights, 1};
    }

    std::vector<MeshData> meshes;
    std::vector<MaterialData> materials;
    std::vector<TextureData> textures;
    std::vector<InstanceData> instances;
    std::vector<CameraData> cameras;
    std::vector<LightData> lights;

private:
    template <std::size_t count, typename Vector>
    static std::span<const std::array<float, count>> rows(const std::vector<Vector>& vectors) {
        static_assert(sizeof(Vector) == sizeof(std::array<float, count>));
        return {reinterpret_cast<const std::array<float, count>*>(vectors.data()), vectors.size()};
    }

    static Matrix4 matrixOf(const glm::dmat4& matrix) {
        Matrix4 result;
        std::copy_n(glm::value_ptr(matrix), result.size(), result.begin());
        return result;
    }

    // Decodes the bytes of a texture to linear floats. The texture's content is `color` if a material uses the texture
    // as base colour or emission, else `data`.
    void addTexture(int index) {
        const Texture& texture = scene_.textures[static_cast<std::size_t>(index)];
        const TextureImage& image = scene_.images[static_cast<std::size_t>(texture.image)];
        const bool colors = std::ranges::any_of(scene_.materials, [&](const Material& material) {
            return material.baseColor.texture == index || material.emissive.texture == index;
        });
        Image& floats = images_.emplace_back(image.width, image.height, 4);
        for (std::size_t i = 0; i < image.rgba.size(); ++i) {
            const float value = static_cast<float>(image.rgba[i]) / 255;
            floats.pixels[i] = colors && i % 4 != 3 ? srgbDecode(value) : value;
        }
        TextureData data;
        data.name = scene_.imageNames[static_cast<std::size_t>(texture.image)];
        data.image = floats;
        data.content = colors ? TextureContent::color : TextureContent::data;
        data.straightAlpha = true;
        data.wrapU = texture.wrapS;
        data.wrapV = texture.wrapT;
        data.magnification = texture.magnification;
        data.minification = texture.minification;
        data.mipmaps = texture.mipmaps;
        textures.push_back(data);
    }

    void addMaterial(const Material& material) {
        MaterialData data;
        data.name = material.name;
        std::copy_n(&material.baseColorFactor.x, 4, data.baseColor.begin());
        data.baseColorTexture = material.baseColor.texture;
        data.metallic = material.metallicFactor;
        data.roughness = material.roughnessFactor;
        data.metallicRoughnessTexture = material.metallicRoughness.texture;
        data.normalTexture = material.normal.texture;
        data.normalScale = material.normalScale;
        data.occlusionTexture = material.occlusion.texture;
        data.occlusionStrength = material.occlusionStrength;
        std::copy_n(&material.emissiveFactor.x, 3, data.emission.begin());
        data.emissionTexture = material.emissive.texture;
        data.alphaMode = material.alphaMode;
        data.alphaCutoff = material.alphaCutoff;
        data.doubleSided = material.doubleSided;
        data.unlit = material.unlit;
        data.ior = material.ior;
        data.transmission = material.transmissionFactor;
        data.transmissionTexture = material.transmission.texture;
        data.thickness = material.thicknessFactor;
        data.attenuationDistance = material.attenuationDistance;
        std::copy_n(&material.attenuationColor.x, 3, data.attenuationColor.begin());
        materials.push_back(data);
    }

    void addMesh(const Mesh& mesh) {
        MeshData data;
        data.name = mesh.name;
        data.positions = rows<3>(mesh.vertices.positions);
        data.normals = rows<3>(mesh.vertices.normals);
        data.uvs = rows<2>(mesh.vertices.uv0);
        data.colors = rows<4>(mesh.vertices.colors);
        data.indices = mesh.primitives.at(0).indices;
        data.material = mesh.primitives.at(0).material;
        meshes.push_back(data);
    }

    void addNode(const Node& node, const glm::dmat4& worldFromNode) {
        const Matrix4 transform = matrixOf(worldFromNode);
        if (node.mesh >= 0) instances.push_back({node.name, node.mesh, transform});
        if (node.camera >= 0) {
            const Camera& camera = scene_.cameras[static_cast<std::size_t>(node.camera)];
            CameraData data;
            data.name = camera.name;
            data.transform = transform;
            data.yfov = camera.yfov;
            data.znear = camera.znear;
            data.focusDistance = camera.lensValue("focusDistance");
            data.lens.fStop = camera.lensValue("fStop");
            data.lens.horizontalAperture = camera.lensValue("horizontalAperture");
            cameras.push_back(data);
        }
        if (node.light >= 0) {
            const Light& light = scene_.lights[static_cast<std::size_t>(node.light)];
            LightData data;
            data.name = light.name;
            data.type = light.type;
            data.transform = transform;
            std::copy_n(&light.color.x, 3, data.color.begin());
            data.intensity = light.intensity;
            data.range = light.range;
            data.innerConeAngle = light.innerConeAngle;
            data.outerConeAngle = light.outerConeAngle;
            lights.push_back(data);
        }
    }

    const Scene& scene_;
    std::deque<Image> images_;
};

}  // namespace defocus::engine
