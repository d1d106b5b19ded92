// Defaults and ranges follow the glTF 2.0 specification (meshes 3.7.2, textures 3.8, materials 3.9, cameras 3.10) and
// KHR_lights_punctual.
#include "scene/scene_from_data.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/message.h"
#include "scene/finish_mesh.h"
#include "scene/texture_from_data.h"

namespace defocus::engine {

namespace {

template <typename... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> format, Args&&... args) {
    throw UsageError(shortLine(fmt::format(format, std::forward<Args>(args)...)));
}

// ---- checks of values ----------------------------------------------------------------------------------------------

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double maxFloat = std::numeric_limits<float>::max();

// Throws UsageError unless min ≤ value ≤ max.
void checkRange(const std::string& label, const char* name, double value, double min, double max) {
    if (value >= min && value <= max) return;
    if (max >= maxFloat) refuse("{}: {} is {}; it must be a finite number of at least {}", label, name, value, min);
    refuse("{}: {} is {}; it must be from {} to {}", label, name, value, min, max);
}

// Throws UsageError unless the value is finite and > 0.
void checkPositive(const std::string& label, const char* name, double value) {
    if (!(value > 0 && value < infinity))
        refuse("{}: {} is {}; it must be a finite number above 0", label, name, value);
}

template <std::size_t count>
void checkRange(const std::string& label, const char* name, const std::array<float, count>& values, double min,
                double max) {
    for (const float value : values) checkRange(label, name, value, min, max);
}

// Throws UsageError unless the value is an enumerator; `last` is the type's last enumerator.
template <typename Choice>
void checkChoice(const std::string& label, const char* name, Choice value, Choice last) {
    if (static_cast<int>(value) >= 0 && value <= last) return;
    refuse("{}: {} has no value {}", label, name, static_cast<int>(value));
}

// Throws UsageError unless `index` is −1 or below `count`, the number of items of the type `kind`, such as "mesh".
void checkIndex(const std::string& label, const char* kind, int index, std::size_t count) {
    if (index >= -1 && (index < 0 || static_cast<std::size_t>(index) < count)) return;
    refuse("{}: there is no {} {}; the scene has {}", label, kind, index, count);
}

glm::dmat4 checkedTransform(const std::string& label, const Matrix4& transform) {
    const glm::dmat4 matrix = glm::make_mat4(transform.data());
    for (const double element : transform)
        if (!std::isfinite(element)) refuse("{}: its transform is not finite (NaN or infinite)", label);
    if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1)
        refuse("{}: the last row of its transform is {}, {}, {}, {} instead of 0, 0, 0, 1; matrices are column-major",
               label, matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3]);
    return matrix;
}

// ---- meshes ---------------------------------------------------------------------------------------------------------

// Returns a vertex attribute as vectors; empty if the attribute is absent. Throws UsageError for NaN, infinity, or a
// count other than `vertices`.
template <typename Vector, std::size_t count>
std::vector<Vector> attribute(const std::string& label, const char* name,
                              std::span<const std::array<float, count>> values, std::size_t vertices) {
    if (!values.empty() && values.size() != vertices)
        refuse("{}: it has {} {} for {} positions; give one for each position, or none", label, values.size(), name,
               vertices);
    std::vector<Vector> result(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        for (std::size_t c = 0; c < count; ++c) {
            if (!std::isfinite(values[i][c])) refuse("{}: {}[{}] is not finite (NaN or infinite)", label, name, i);
            result[i][static_cast<glm::length_t>(c)] = values[i][c];
        }
    return result;
}

std::vector<std::uint32_t> trianglesOf(const std::string& label, const MeshData& data) {
    const std::size_t vertices = data.positions.size();
    const char* const corners = data.indices.empty() ? "positions" : "indices";
    std::vector<std::uint32_t> indices(data.indices.begin(), data.indices.end());
    if (indices.empty()) {
        indices.resize(vertices);
        std::iota(indices.begin(), indices.end(), 0u);
    }
    if (indices.size() % 3 != 0)
        refuse("{}: it has {} {}, not a multiple of 3; each triangle needs three", label, indices.size(), corners);
    for (const std::uint32_t index : indices)
        if (index >= vertices) refuse("{}: index {} is out of range for {} vertices", label, index, vertices);
    return indices;
}

Mesh meshOf(const std::string& label, const MeshData& data, Scene& scene) {
    if (data.positions.empty()) refuse("{}: it has no positions", label);
    if (data.positions.size() > std::numeric_limits<std::uint32_t>::max())
        refuse("{}: it has {} positions, more than 32-bit indices can address", label, data.positions.size());
    checkIndex(label, "material", data.material, scene.materials.size());
    VertexBlock block;
    Vertices& vertices = block.vertices;
    const std::size_t count = data.positions.size();
    vertices.positions = attribute<glm::vec3>(label, "positions", data.positions, count);
    vertices.normals = attribute<glm::vec3>(label, "normals", data.normals, count);
    vertices.uv0 = attribute<glm::vec2>(label, "uvs", data.uvs, count);
    vertices.colors = attribute<glm::vec4>(label, "colors", data.colors, count);
    for (std::size_t i = 0; i < data.colors.size(); ++i)
        for (const float value : data.colors[i])
            if (!(value >= 0 && value <= 1))
                refuse("{}: colors[{}] is {}; colours must be from 0 to 1", label, i, value);
    if (data.uvs.empty() && data.material >= 0) {
        const Material& material = scene.materials[static_cast<std::size_t>(data.material)];
        if (std::ranges::any_of(textureUses(material), &TextureUse::used))
            refuse("{}: its material {} has textures, but the mesh has no uvs", label, data.material);
    }

    Mesh mesh;
    mesh.name = data.name;
    mesh.primitives.push_back({data.material, trianglesOf(label, data)});
    std::vector<std::uint32_t>* const lists[] = {&mesh.primitives.front().indices};
    block = compacted(block, lists);
    const std::size_t replaced = repairAttributes(block, lists);
    if (replaced > 0) scene.ignored.push_back(replacedNormalsNote(replaced));
    append(mesh, withMissingAttributes(std::move(block), lists, tangentUvSet(mesh.primitives, scene.materials)));
    mesh.blurBounds = boundsOf(mesh.vertices.blurs);
    return mesh;
}

// ---- materials ------------------------------------------------------------------------------------------------------

// Returns a reference to the texture with index `texture`. Throws UsageError if the texture doesn't exist or its
// content is not `content`.
TextureUse textureUse(const std::string& label, const char* name, int texture, TextureContent content,
                      std::span<const TextureData> textures) {
    checkIndex(label, "texture", texture, textures.size());
    if (texture >= 0 && textures[static_cast<std::size_t>(texture)].content != content)
        refuse("{}: texture {} holds {}; as {} it must hold {}", label, texture,
               content == TextureContent::color ? "data" : "colours", name,
               content == TextureContent::color ? "colours" : "data");
    TextureUse use;
    use.texture = texture;
    return use;
}

Material materialOf(const std::string& label, const MaterialData& data, std::span<const TextureData> textures) {
    checkChoice(label, "alphaMode", data.alphaMode, AlphaMode::blend);
    checkRange(label, "baseColor", data.baseColor, 0, 1);
    checkRange(label, "metallic", data.metallic, 0, 1);
    checkRange(label, "roughness", data.roughness, 0, 1);
    checkRange(label, "normalScale", data.normalScale, -maxFloat, maxFloat);
    checkRange(label, "occlusionStrength", data.occlusionStrength, 0, 1);
    checkRange(label, "emission", data.emission, 0, maxFloat);
    checkRange(label, "alphaCutoff", data.alphaCutoff, 0, maxFloat);
    if (data.ior != 0) checkRange(label, "ior", data.ior, 1, maxFloat);
    checkRange(label, "transmission", data.transmission, 0, 1);
    checkRange(label, "thickness", data.thickness, 0, maxFloat);
    checkRange(label, "attenuationColor", data.attenuationColor, 0, 1);
    if (!(data.attenuationDistance > 0))
        refuse("{}: attenuationDistance is {}; it must be above 0", label, data.attenuationDistance);
    const auto use = [&](const char* name, int texture, TextureContent content) {
        return textureUse(label, name, texture, content, textures);
    };
    constexpr TextureContent color = TextureContent::color;
    constexpr TextureContent numbers = TextureContent::data;
    Material material;
    material.name = data.name;
    material.baseColorFactor = glm::make_vec4(data.baseColor.data());
    material.metallicFactor = data.metallic;
    material.roughnessFactor = data.roughness;
    material.emissiveFactor = glm::make_vec3(data.emission.data());
    material.normalScale = data.normalScale;
    material.occlusionStrength = data.occlusionStrength;
    material.baseColor = use("baseColorTexture", data.baseColorTexture, color);
    material.metallicRoughness = use("metallicRoughnessTexture", data.metallicRoughnessTexture, numbers);
    material.normal = use("normalTexture", data.normalTexture, numbers);
    material.occlusion = use("occlusionTexture", data.occlusionTexture, numbers);
    material.emissive = use("emissionTexture", data.emissionTexture, color);
    material.transmission = use("transmissionTexture", data.transmissionTexture, numbers);
    material.alphaMode = data.alphaMode;
    material.alphaCutoff = data.alphaCutoff;
    material.doubleSided = data.doubleSided;
    material.unlit = data.unlit;
    material.ior = data.ior;
    material.transmissionFactor = data.transmission;
    material.thicknessFactor = data.thickness;
    material.attenuationDistance = data.attenuationDistance;
    material.attenuationColor = glm::make_vec3(data.attenuationColor.data());
    return material;
}

void addTexture(const std::string& label, const TextureData& data, Scene& scene) {
    checkChoice(label, "content", data.content, TextureContent::data);
    for (const TextureWrap wrap : {data.wrapU, data.wrapV})
        checkChoice(label, "wrap", wrap, TextureWrap::mirroredRepeat);
    for (const TextureFilter filter : {data.magnification, data.minification})
        checkChoice(label, "filter", filter, TextureFilter::linear);
    Texture texture;
    texture.image = static_cast<int>(scene.images.size());
    texture.wrapS = data.wrapU;
    texture.wrapT = data.wrapV;
    texture.magnification = data.magnification;
    texture.minification = data.minification;
    texture.mipmaps = data.mipmaps;
    scene.textures.push_back(texture);
    scene.images.push_back(textureImage(data, shortLine(label)));
    scene.imageNames.push_back(data.name.empty() ? fmt::format("texture {}", scene.imageNames.size()) : data.name);
}

// ---- nodes ----------------------------------------------------------------------------------------------------------

Node& addNode(const std::string& label, const std::string& name, const Matrix4& transform, Scene& scene) {
    scene.roots.push_back(static_cast<int>(scene.nodes.size()));
    Node& node = scene.nodes.emplace_back();
    node.name = name;
    node.matrix = checkedTransform(label, transform);
    return node;
}

void addInstance(const std::string& label, const InstanceData& data, Scene& scene) {
    if (data.mesh < 0) refuse("{}: there is no mesh {}", label, data.mesh);
    checkIndex(label, "mesh", data.mesh, scene.meshes.size());
    const std::string& meshName = scene.meshes[static_cast<std::size_t>(data.mesh)].name;
    addNode(label, data.name.empty() ? meshName : data.name, data.transform, scene).mesh = data.mesh;
}

void addCamera(const std::string& label, const CameraData& data, Scene& scene) {
    if (!(data.yfov > 0 && data.yfov < std::numbers::pi))
        refuse("{}: yfov is {}; it must be between 0 and π radians", label, data.yfov);
    checkPositive(label, "znear", data.znear);
    if (data.focusDistance) checkPositive(label, "focusDistance", *data.focusDistance);
    Camera camera;
    camera.name = data.name;
    camera.yfov = data.yfov;
    camera.znear = data.znear;
    if (data.focusDistance) camera.lens["focusDistance"] = *data.focusDistance;
    addNode(label, data.name, data.transform, scene).camera = static_cast<int>(scene.cameras.size());
    scene.cameras.push_back(std::move(camera));
}

void addLight(const std::string& label, const LightData& data, Scene& scene) {
    constexpr double rightAngle = std::numbers::pi / 2 + 1e-4;  // 1e-4 accepts a π/2 that was rounded up
    checkChoice(label, "type", data.type, LightType::spot);
    checkRange(label, "color", data.color, 0, maxFloat);
    checkRange(label, "intensity", data.intensity, 0, maxFloat);
    checkRange(label, "range", data.range, 0, maxFloat);
    checkRange(label, "angularDiameter", data.angularDiameter, 0, std::numbers::pi);
    checkRange(label, "radius", data.radius, 0, maxFloat);
    const bool cone = data.innerConeAngle >= 0 && data.innerConeAngle < data.outerConeAngle &&
                      static_cast<double>(data.outerConeAngle) <= rightAngle;
    if (data.type == LightType::spot && !cone)
        refuse("{}: a cone from {} to {} radians is impossible; angles are 0 ≤ inner < outer ≤ π/2", label,
               data.innerConeAngle, data.outerConeAngle);
    Light light;
    light.name = data.name;
    light.type = data.type;
    light.color = glm::make_vec3(data.color.data());
    light.intensity = data.intensity;
    light.range = data.range;
    light.innerConeAngle = data.innerConeAngle;
    light.outerConeAngle = data.outerConeAngle;
    light.angularDiameter = data.angularDiameter;
    light.radius = data.radius;
    addNode(label, data.name, data.transform, scene).light = static_cast<int>(scene.lights.size());
    scene.lights.push_back(light);
}

}  // namespace

std::string partLabel(std::string_view kind, std::size_t index, const std::string& name) {
    return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} '{}' ({})", kind, name, index);
}

Scene sceneFromData(const SceneData& data) {
    checkRange("the scene", "metresPerUnit", data.metresPerUnit, 1e-9, 1e9);
    if (data.instances.empty()) refuse("the scene is empty; add an instance of a mesh");
    const auto each = [](std::string_view kind, const auto& parts, const auto& add) {
        for (std::size_t i = 0; i < parts.size(); ++i) add(partLabel(kind, i, parts[i].name), parts[i]);
    };
    Scene scene;
    scene.name = data.name.empty() ? "scene" : shortLine(data.name);
    scene.ownMetresPerUnit = data.metresPerUnit;

    // Add textures and materials before meshes: meshes with normal-mapped materials need tangents.
    each("texture", data.textures, [&](const auto& label, const auto& part) { addTexture(label, part, scene); });
    each("material", data.materials, [&](const auto& label, const auto& part) {
        scene.materials.push_back(materialOf(label, part, data.textures));
    });
    each("mesh", data.meshes,
         [&](const auto& label, const auto& part) { scene.meshes.push_back(meshOf(label, part, scene)); });
    each("instance", data.instances, [&](const auto& label, const auto& part) { addInstance(label, part, scene); });
    each("camera", data.cameras, [&](const auto& label, const auto& part) { addCamera(label, part, scene); });
    each("light", data.lights, [&](const auto& label, const auto& part) { addLight(label, part, scene); });
    if (const std::string placed = placedAtInfinity(scene); !placed.empty())
        refuse("the transform of {} is not finite", placed);
    return scene;
}

}  // namespace defocus::engine
