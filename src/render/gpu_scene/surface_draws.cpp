#include "render/gpu_scene/surface_draws.h"

#include <algorithm>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "plan/motion/object_pose.h"

namespace defocus::engine {

namespace {

bool local(const PlacedLight& placed) {
    return placed.light.type != LightType::directional;
}

}  // namespace

std::size_t uniformStride(std::size_t bytes) {
    GLint alignment = 256;
    glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
    const auto step = static_cast<std::size_t>(alignment);
    return (bytes + step - 1) / step * step;
}

namespace {

// Returns the max deviation in m of the object's drawn levels from full detail.
double levelError(const World& world, const ObjectPlan& object) {
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
    double error = 0;
    for (const LevelDraw& draw : {object.coarse, object.fine})
        if (draw.sampleCount > 0) error = std::max(error, pyramid.levels[draw.level].error);
    return error * largestScale(object.pose);
}

}  // namespace

UniformBlocks<GpuObject> objectBlocks(const FramePlan& plan, GpuScene& scene, std::vector<GpuPoses>& poses) {
    std::vector<GpuObject> blocks;
    blocks.reserve(plan.objects.size());
    poses.clear();
    for (const ObjectPlan& object : plan.objects) {
        const GpuMesh& mesh = scene.mesh(object.mesh);
        poses.push_back(gpuPoses(plan, object, mesh));
        blocks.push_back({glm::mat4(glm::translate(object.viewFromObject, mesh.origin)),
                          glm::mat4(glm::mat3(glm::inverseTranspose(glm::dmat3(object.viewFromObject)))),
                          glm::vec4(object.lambda, object.boundaryShare, object.object, object.cocScale),
                          poses.back().layout, glm::vec4(levelError(scene.world(), object), 0, 0, 0)});
    }
    return UniformBlocks<GpuObject>(blocks);
}

std::vector<IndexRun> indexRuns(const World& world, const ObjectPlan& object, const GpuMesh& mesh, std::uint32_t level,
                                std::uint32_t primitive) {
    const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
    const IndexRange whole = pyramid.levels[level].primitives[primitive];
    const VisibleLevel* visible = visibleLevel(object, level);
    const std::vector<IndexRange> ranges =
        visible != nullptr ? visible->primitives[primitive] : std::vector<IndexRange>{whole};
    const std::size_t offset = mesh.levels[level].indexOffsets[primitive];
    std::vector<IndexRun> runs;
    for (const IndexRange& range : ranges) {
        const std::size_t first = offset / sizeof(std::uint32_t) + range.first - whole.first;
        runs.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(range.count)});
    }
    return runs;
}

ShaderDefines surfaceDefines(const GpuScene& scene, const GpuMesh& mesh, int materialIndex, std::uint32_t level,
                             SurfaceLook look) {
    static constexpr const char* textureDefines[materialTextureCount] = {"BASE_COLOR_TEXTURE",
                                                                         "METALLIC_ROUGHNESS_TEXTURE",
                                                                         "NORMAL_TEXTURE",
                                                                         "OCCLUSION_TEXTURE",
                                                                         "EMISSIVE_TEXTURE",
                                                                         "SPECULAR_TEXTURE",
                                                                         "SPECULAR_COLOR_TEXTURE",
                                                                         "TRANSMISSION_TEXTURE",
                                                                         "THICKNESS_TEXTURE",
                                                                         "CLEARCOAT_TEXTURE",
                                                                         "CLEARCOAT_ROUGHNESS_TEXTURE",
                                                                         "CLEARCOAT_NORMAL_TEXTURE",
                                                                         "SHEEN_COLOR_TEXTURE",
                                                                         "SHEEN_ROUGHNESS_TEXTURE"};
    constexpr std::size_t normalSlots[] = {2, 11};
    constexpr std::size_t transmissionSlots[] = {7, 8};
    const bool shaded = look == SurfaceLook::lit || look == SurfaceLook::seenThrough;
    const Material& material = scene.material(materialIndex);
    ShaderDefines defines;
    const auto set = [&](bool condition, const char* name) {
        if (condition) defines.emplace_back(name, "1");
    };
    const bool hasUv = static_cast<bool>(mesh.uv0) || static_cast<bool>(mesh.uv1);
    const GpuMaterialTextures& textures = scene.textures(materialIndex);
    const bool passes = look == SurfaceLook::caster && (material.transmits() || material.alphaMode == AlphaMode::blend);
    const bool masked = material.alphaMode == AlphaMode::mask || passes;
    const bool transmits = look == SurfaceLook::seenThrough && material.transmits();
    const auto uses = textureUses(material);
    bool textured = false;
    bool transformed = false;
    bool bumped = false;
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const bool ofNormals = std::ranges::count(normalSlots, i) > 0;
        const bool wanted = shaded ? transmits || std::ranges::count(transmissionSlots, i) == 0 : i == 0 && masked;
        const bool used = textures.slots[i] != nullptr && hasUv && wanted && (!ofNormals || mesh.tangents);
        bumped |= used && ofNormals;
        textured |= used;
        transformed |= used && (uses[i]->uvSet != 0 || uses[i]->uvTransform != glm::mat3(1.0f));
        set(used, textureDefines[i]);
    }
    const bool lit = shaded && !material.unlit;
    const std::vector<PlacedLight>& lights = scene.world().lights;
    set(textured, "TEXTURED");
    set(transformed, "UV_TRANSFORMS");
    set(!lit, "UNLIT");
    set(lit && material.emissiveFactor != glm::vec3(0), "EMISSIVE");
    set(bumped, "TANGENTS");
    set(look == SurfaceLook::caster && material.transmits(), "LETS_LIGHT_PASS");
    set(transmits, "TRANSMISSION");
    set(lit && material.hasOwnReflectance(), "OWN_REFLECTANCE");
    set(lit && material.hasClearcoat(), "CLEARCOAT");
    set(lit && material.hasSheen(), "SHEEN");
    set(lit && level > 0, "COARSE_LEVEL");
    set(lit && std::any_of(lights.begin(), lights.end(), local), "LOCAL_LIGHTS");
    set(static_cast<bool>(mesh.colors), "VERTEX_COLORS");
    set(material.doubleSided, "DOUBLE_SIDED");
    return defines;
}

std::string keyOf(const ShaderDefines& defines) {
    std::string key;
    for (const auto& [name, value] : defines) key.append(name).append("=").append(value).append(";");
    return key;
}

}  // namespace defocus::engine
