#pragma once
// Fixture for tests of glass panes in front of the camera (KHR_materials_transmission and _volume).

#include "render/lit_wall.h"

namespace defocus::engine {

class Transmission : public LitWall {
protected:
    static Material glass(float roughness = 0) {
        return {.metallicFactor = 0, .roughnessFactor = roughness, .transmissionFactor = 1};
    }

    // Returns a material of glass that reflects nothing and colours transmitted light by `tint`.
    static Material clear(const glm::vec3& tint = glm::vec3(1)) {
        Material result = glass();
        result.baseColorFactor = glm::vec4(tint, 1);
        result.specularFactor = 0;
        return result;
    }

    // Adds a copy of the wall's quad with another material, `depth` m in front of the camera.
    static void addWall(SmallWorld& small, double depth, const Material& material, double scale = 1) {
        small.scene.materials.push_back(material);
        Mesh mesh = quad(static_cast<int>(small.scene.materials.size()) - 1);
        mesh.vertices.colors = {
            {0, 0.25f, 1, 1}, {1, 0.25f, 1, 1}, {1, 0.75f, 1, 1}, {0, 0.75f, 1, 1}};  // the red channel grows along x
        small.scene.meshes.push_back(std::move(mesh));
        place(small, static_cast<int>(small.scene.meshes.size()) - 1,
              glm::scale(glm::translate(small.view.worldFromCamera, glm::dvec3(0, 0, -depth)), glm::dvec3(scale)));
        finish(small);
    }

    static Image drawnBy(const char* method, const SmallWorld& small, std::uint32_t samples) {
        RenderSettings settings{.sampleCount = samples, .lod = LodMode::off};
        RendererOptions options{.layerFormat = LayerFormat::rgba32f};
        const MethodUse use = parseMethodUse(method);
        options.settings = use.settings;
        return imageOf(*use.method->make(small.world, options), planFrame(small.world, small.view, settings));
    }
};

}  // namespace defocus::engine
