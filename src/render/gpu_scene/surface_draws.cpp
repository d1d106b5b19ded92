#include "render/gpu_scene/surface_draws.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "plan/motion/object_pose.h"
#include "render/gpu_scene/material_blocks.h"

namespace defocus::engine {

namespace {

constexpr GLint objectLocation = 96;  // first uniform location of Object in shaders/include/frame.glsl

bool local(const PlacedLight& placed) {
    return placed.light.type != LightType::directional;
}

// Returns the max deviation in m of the object's drawn levels from full detail.
double levelError(const World& world, const ObjectPlan& object) {
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
    double error = 0;
    for (const LevelDraw& draw : {object.coarse, object.fine})
        if (draw.sampleCount > 0) error = std::max(error, pyramid.levels[draw.level].error);
    return error * largestScale(object.pose);
}

}  // namespace

std::vector<GpuObject> objectUniforms(const FramePlan& plan, const GpuScene& scene, std::vector<GpuPoses>& poses) {
    poses.clear();
    poses.reserve(plan.objects.size());
    std::vector<GpuObject> objects;
    objects.reserve(plan.objects.size());
    for (const ObjectPlan& object : plan.objects) {
        const GpuMesh& mesh = scene.mesh(object.mesh);
        poses.push_back(gpuPoses(plan, object, mesh));
        objects.push_back({glm::mat4(glm::translate(object.viewFromObject, mesh.origin)),
                           glm::mat3(glm::inverseTranspose(glm::dmat3(object.viewFromObject))),
                           glm::vec4(object.lambda, object.boundaryShare, object.object, object.cocScale),
                           poses.back().layout, glm::vec2(levelError(scene.world(), object), object.maxParts)});
    }
    return objects;
}

void setObject(const GpuObject& object) {
    glUniformMatrix4fv(objectLocation, 1, GL_FALSE, &object.viewFromObject[0].x);
    glUniformMatrix3fv(objectLocation + 1, 1, GL_FALSE, &object.normalMatrix[0].x);
    glUniform4fv(objectLocation + 2, 1, &object.values.x);
    glUniform4iv(objectLocation + 3, 1, &object.posing.x);
    glUniform2fv(objectLocation + 4, 1, &object.levels.x);
}

std::vector<IndexRun> indexRuns(const World& world, const ObjectPlan& object, const GpuMesh& mesh, std::uint32_t level,
                                std::uint32_t primitive) {
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
    const IndexRange whole = pyramid.levels[level].primitives[primitive];
    const VisibleLevel* visible = visibleLevel(object, level);
    const std::vector<IndexRange> ranges =
        visible != nullptr ? visible->primitives[primitive] : std::vector<IndexRange>{whole};
    const std::size_t levelFirst = pyramid.levels[level].primitives.front().first;
    std::vector<IndexRun> runs;
    for (const IndexRange& range : ranges) {
        const std::size_t first = mesh.levels[level].firstIndex + range.first - levelFirst;
        runs.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(range.count)});
    }
    return runs;
}

ShaderDefines surfaceDefines(const GpuScene& scene, const GpuMesh& mesh, int materialIndex, std::uint32_t level,
                             SurfaceLook look) {
    using enum TextureSlot;
    const bool shaded = look == SurfaceLook::lit || look == SurfaceLook::seenThrough;
    const Material& material = scene.material(materialIndex);
    ShaderDefines defines;
    const auto set = [&](bool condition, const char* name) {
        if (condition) defines.emplace_back(name, "true");
    };
    const bool hasUv = mesh.has(uv0Location) || mesh.has(uv1Location);
    const GpuMaterialTextures& textures = scene.textures(materialIndex);
    const bool transmits = look == SurfaceLook::seenThrough && material.transmits();
    const bool letsLightPass = look == SurfaceLook::caster && material.transmits();
    const bool masked = material.alphaMode == AlphaMode::mask || letsLightPass ||
                        (look == SurfaceLook::caster && material.alphaMode == AlphaMode::blend);
    const auto uses = textureUses(material);
    std::array<int, materialTextureCount> units{};
    bool textured = false;
    bool transformed = false;
    bool bumped = false;
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const auto slot = static_cast<TextureSlot>(i);
        const bool ofTangents = slot == normal || slot == clearcoatNormal || slot == anisotropy;
        const bool ofTransmission = slot == transmission || slot == thickness;
        const bool wanted =
            shaded ? transmits || !ofTransmission
                   : (slot == baseColor && masked) || ((slot == metallicRoughness || ofTransmission) && letsLightPass);
        const bool used = textures.slots[i] != nullptr && hasUv && wanted && (!ofTangents || mesh.has(tangentLocation));
        bumped |= used && ofTangents;
        textured |= used;
        transformed |= used && transformsUv(*uses[i]);
        units[i] = used ? textures.unit(i) : -1;
    }
    if (textured) {
        defines.emplace_back("TEXTURED", "");
        defines.emplace_back("textureCount", std::to_string(textures.count()));
        defines.emplace_back("textureUnits", fmt::format("int[]({})", fmt::join(units, ",")));
    }
    const bool lit = shaded && !material.unlit;
    const bool anisotropic = lit && material.isAnisotropic() && mesh.has(tangentLocation);
    if (bumped || anisotropic) defines.emplace_back("BUMPED", "");
    const std::vector<PlacedLight>& lights = scene.world().lights;
    const bool hasLocalLights = lit && std::any_of(lights.begin(), lights.end(), local);
    if (hasLocalLights || transmits) defines.emplace_back("PLACED", "");
    set(transformed, "uvTransforms");
    set(lit, "lit");
    set(lit && material.emissiveFactor != glm::vec3(0), "emissive");
    set(letsLightPass, "letsLightPass");
    set(transmits, "transmissive");
    set(lit && material.hasOwnReflectance(), "ownReflectance");
    set(lit && material.hasClearcoat(), "clearcoat");
    set(lit && material.hasSheen(), "sheen");
    set(anisotropic, "anisotropic");
    set(lit && material.isIridescent(), "iridescent");
    set(transmits && material.isDispersive(), "dispersive");
    set(lit && material.transmitsDiffusely(), "diffusesThrough");
    set(lit && level > 0, "coarseLevel");
    set(hasLocalLights, "localLights");
    set(mesh.has(colorLocation), "vertexColors");
    set(material.doubleSided, "doubleSided");
    return defines;
}

std::string keyOf(const ShaderDefines& defines) {
    std::string key;
    for (const auto& [name, value] : defines) key.append(name).append("=").append(value).append(";");
    return key;
}

}  // namespace defocus::engine
