#pragma once
// Scene data in glTF 2.0's terms, read from a file or generated; independent of the GPU. Units: metres (unless
// Scene::metresPerUnit ≠ 1), radians, linear Rec.709. Right-handed, y up, cameras look along −z.

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "defocus/scene_data.h"
#include "image/image.h"
#include "scene/camera.h"
#include "scene/camera_track.h"
#include "scene/mesh.h"

namespace defocus::engine {

// ---- materials ----------------------------------------------------------------------------------

using Wrap = TextureWrap;
using Filter = TextureFilter;

struct Texture {
    int image = -1;  // index into Scene::images; −1: none
    Wrap wrapS = Wrap::repeat;
    Wrap wrapT = Wrap::repeat;
    Filter magnification = Filter::linear;
    Filter minification = Filter::linear;
    bool mipmaps = true;
};

struct TextureUse {
    int texture = -1;             // index into Scene::textures; -1: none
    int uvSet = 0;                // texture coordinate set, 0 or 1
    glm::mat3 uvTransform{1.0f};  // KHR_texture_transform: uv' = (uvTransform · (u, v, 1)).xy
    [[nodiscard]] bool used() const { return texture >= 0; }
};

struct Material {
    std::string name = {};
    glm::vec4 baseColorFactor{1.0f};  // linear colour, straight alpha
    float metallicFactor = 1.0f;
    float roughnessFactor = 1.0f;
    glm::vec3 emissiveFactor{0.0f};  // includes KHR_materials_emissive_strength
    float normalScale = 1.0f;
    float occlusionStrength = 1.0f;
    TextureUse baseColor = {};          // sRGB-encoded
    TextureUse metallicRoughness = {};  // linear values; roughness in G, metalness in B
    TextureUse normal = {};             // linear values; normal in tangent space, +y up
    TextureUse occlusion = {};          // linear values in channel R
    TextureUse emissive = {};           // sRGB-encoded
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;  // alpha below which AlphaMode::mask draws nothing
    bool doubleSided = false;
    bool unlit = false;  // KHR_materials_unlit

    // KHR_materials_ior and KHR_materials_specular: reflectance of the dielectric part of the material.
    float ior = 1.5f;  // index of refraction ≥ 1; 0: reflectance 1 at all angles
    float specularFactor = 1.0f;
    glm::vec3 specularColorFactor{1.0f};
    TextureUse specular = {};       // linear values in channel A
    TextureUse specularColor = {};  // sRGB-encoded

    // KHR_materials_transmission and KHR_materials_volume.
    float transmissionFactor = 0.0f;
    TextureUse transmission = {};  // linear values in channel R
    float thicknessFactor = 0.0f;  // thickness in object units; 0: thin wall without refraction
    TextureUse thickness = {};     // linear values in channel G
    float attenuationDistance = std::numeric_limits<float>::infinity();  // distance in scene units; +∞: no absorption
    glm::vec3 attenuationColor{1.0f};

    // KHR_materials_clearcoat.
    float clearcoatFactor = 0.0f;
    float clearcoatRoughnessFactor = 0.0f;
    float clearcoatNormalScale = 1.0f;
    TextureUse clearcoat = {};           // linear values in channel R
    TextureUse clearcoatRoughness = {};  // linear values in channel G
    TextureUse clearcoatNormal = {};     // like `normal`; without it, the coat uses the mesh normal

    // KHR_materials_sheen.
    glm::vec3 sheenColorFactor{0.0f};
    float sheenRoughnessFactor = 0.0f;
    TextureUse sheenColor = {};      // sRGB-encoded
    TextureUse sheenRoughness = {};  // linear values in channel A

    // KHR_materials_anisotropy. The rotation is the angle from the tangent to the direction of stretched highlights,
    // counter-clockwise.
    float anisotropyStrength = 0.0f;
    float anisotropyRotation = 0.0f;  // rad
    TextureUse anisotropy = {};       // linear values; direction in RG, strength in B

    // KHR_materials_iridescence: a thin film on the surface.
    float iridescenceFactor = 0.0f;
    float iridescenceIor = 1.3f;                 // ≥ 1
    float iridescenceThicknessMinimum = 100.0f;  // nm
    float iridescenceThicknessMaximum = 400.0f;  // max thickness in nm; also the thickness without a texture
    TextureUse iridescence = {};                 // linear values in channel R
    TextureUse iridescenceThickness = {};        // linear values in channel G

    // KHR_materials_dispersion: 20 divided by the Abbe number; 0: none.
    float dispersion = 0.0f;

    // KHR_materials_diffuse_transmission.
    float diffuseTransmissionFactor = 0.0f;
    glm::vec3 diffuseTransmissionColorFactor{1.0f};
    TextureUse diffuseTransmission = {};       // linear values in channel A
    TextureUse diffuseTransmissionColor = {};  // sRGB-encoded

    // Returns whether surfaces behind this material are visible through it by transmission.
    [[nodiscard]] bool transmits() const { return !unlit && transmissionFactor > 0; }
    // Returns whether the dielectric reflectance may differ from glTF's default of 4 %.
    [[nodiscard]] bool hasOwnReflectance() const {
        return !unlit && (ior != 1.5f || specularFactor != 1 || specularColorFactor != glm::vec3(1) ||
                          specular.used() || specularColor.used());
    }
    [[nodiscard]] bool hasClearcoat() const { return !unlit && clearcoatFactor > 0; }
    [[nodiscard]] bool isAnisotropic() const { return !unlit && anisotropyStrength > 0; }
    [[nodiscard]] bool isIridescent() const { return !unlit && iridescenceFactor > 0; }
    [[nodiscard]] bool isDispersive() const { return transmits() && dispersion > 0 && thicknessFactor > 0; }
    [[nodiscard]] bool transmitsDiffusely() const { return !unlit && diffuseTransmissionFactor > 0; }
    [[nodiscard]] bool hasSheen() const { return !unlit && sheenColorFactor != glm::vec3(0); }
};

inline constexpr std::size_t materialTextureCount = 19;

// Texture slots of a material, in the order of shaders/include/material_textures.glsl.
enum class TextureSlot : std::size_t {
    baseColor,
    metallicRoughness,
    normal,
    occlusion,
    emissive,
    specular,
    specularColor,
    transmission,
    thickness,
    clearcoat,
    clearcoatRoughness,
    clearcoatNormal,
    sheenColor,
    sheenRoughness,
    anisotropy,
    iridescence,
    iridescenceThickness,
    diffuseTransmission,
    diffuseTransmissionColor,
};

// Returns pointers to all textures of a material (const or not), one per TextureSlot.
auto textureUses(auto& m) -> std::array<decltype(&m.baseColor), materialTextureCount> {
    return {&m.baseColor,
            &m.metallicRoughness,
            &m.normal,
            &m.occlusion,
            &m.emissive,
            &m.specular,
            &m.specularColor,
            &m.transmission,
            &m.thickness,
            &m.clearcoat,
            &m.clearcoatRoughness,
            &m.clearcoatNormal,
            &m.sheenColor,
            &m.sheenRoughness,
            &m.anisotropy,
            &m.iridescence,
            &m.iridescenceThickness,
            &m.diffuseTransmission,
            &m.diffuseTransmissionColor};
}

// ---- lights and environment ---------------------------------------------------------------------

struct Light {  // KHR_lights_punctual
    std::string name;
    LightType type = LightType::directional;
    glm::vec3 color{1.0f};
    float intensity = 1.0f;       // illuminance in lux (directional) or intensity in candela (point, spot)
    float range = 0.0f;           // range in m; 0: unlimited
    float innerConeAngle = 0.0f;  // rad
    float outerConeAngle = 0.785398163f;
    // Size of the light, which is a disk that faces the lit point. The size softens shadows. glTF has no light sizes:
    // the defaults are the sizes of the sun and of a light bulb.
    float angularDiameter = 0.00925f;  // angular diameter of directional lights, rad
    float radius = 0.03f;              // radius in m of point and spot lights
};

// Type of the environment that surrounds and lights the scene. L(d) is its radiance in the unit direction d; d.y is up.
enum class EnvironmentType {
    none,      // black and transparent: alpha is the coverage by geometry
    uniform,   // radiance `zenith` in all directions
    gradient,  // radiance mix(horizon, zenith, d.y) for d.y ≥ 0, mix(horizon, nadir, -d.y) below the horizon
    map,       // equirectangular HDR image; the centre column shows −z, the right half shows d.x > 0
};

struct Environment {
    EnvironmentType type = EnvironmentType::gradient;
    glm::vec3 zenith{0.0f};
    glm::vec3 horizon{0.0f};
    glm::vec3 nadir{0.0f};
    std::shared_ptr<const Image> map;  // image of EnvironmentType::map; NaN counts as black
    bool visible = true;               // false: the environment lights the scene, but the background is transparent
    float lighting = 1.0f;             // multiplies the radiance that lights surfaces, but not the background
};

// ---- hierarchy and animation --------------------------------------------------------------------

struct Node {
    std::string name;
    int parent = -1;
    std::vector<int> children;
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
    std::optional<glm::dmat4> matrix;  // if set: replaces translation, rotation and scale; cannot be animated
    int mesh = -1;
    int skin = -1;
    int camera = -1;
    int light = -1;
    std::vector<float> morphWeights;
    double cocScale = 1;  // multiplies the blur of the node's subtree (from extras), ≥ 0; 0: always sharp
    bool visible = true;  // KHR_node_visibility; false: meshes and lights of the node's subtree are not drawn
    bool ground = false;  // true if addGround added this node
    std::vector<glm::dmat4> instances;  // EXT_mesh_gpu_instancing: matrices in node space
};

struct Skin {
    std::string name;
    std::vector<int> joints;                     // indices into Scene::nodes
    std::vector<glm::mat4> inverseBindMatrices;  // one matrix per joint
};

enum class Interpolation { step, linear, cubicSpline };
enum class ChannelPath {
    // Properties of a node
    translation,
    rotation,
    scale,
    weights,  // morph weights
    visible,  // KHR_node_visibility; values from 0.5 are true
    // Properties of a camera (KHR_animation_pointer)
    cameraYfov,   // radians
    cameraZnear,  // near plane, m
    cameraLens,   // entry of Camera::lens named by AnimationChannel::lensValue
    // Properties of a light (KHR_animation_pointer)
    lightColor,
    lightIntensity,
    lightRange,  // m
};

struct AnimationChannel {
    int target = -1;  // index into Scene::nodes, Scene::cameras or Scene::lights, depending on `path`
    ChannelPath path = ChannelPath::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;   // seconds, increasing
    std::vector<float> values;  // per key: 1, 3, 4 or (morph weights) n numbers; three times as many for cubicSpline
    std::string lensValue;      // for ChannelPath::cameraLens: key of Camera::lens
};

struct AnimationClip {
    std::string name;
    std::vector<AnimationChannel> channels;
    float duration = 0.0f;  // time of the last key in seconds
};

// A kind of content in the scene file that is not drawn, and the reason why. `count` is the number of items with the
// same `what` and `reason`.
struct Ignored {
    std::string what;
    std::string reason;
    std::uint64_t count = 1;
    bool damage = false;  // true: ignored because the file is damaged, about which the user is warned
};

struct Scene {
    std::string name;
    std::filesystem::path file;  // source file; empty: none
    bool school = false;         // true: built-in school of fish, lit for an exposure of 0 EV
    std::vector<Mesh> meshes;
    std::vector<Material> materials;  // does not include glTF's default material (Primitive::material −1)
    std::vector<Texture> textures;
    std::vector<TextureImage> images;     // images that materials use
    std::vector<std::string> imageNames;  // one name per entry of `images`
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::vector<Node> nodes;  // nodes of the chosen glTF scene, and joints with their ancestors
    std::vector<int> roots;
    std::vector<Skin> skins;
    std::vector<AnimationClip> clips;
    std::optional<Environment> environment;  // environment; nullopt: see environmentOrDefault
    double metresPerUnit = 1;                // metres per unit of all lengths in this Scene; a Pose is in metres
    std::optional<double> ownMetresPerUnit;  // unit from the file's extras; nullopt: not stated
    std::vector<std::string> variants;       // names of the material variants (KHR_materials_variants)
    std::string variant;                     // chosen material variant; empty: the default materials
    std::vector<std::string> extensions;     // glTF extensions that the file uses, sorted
    std::vector<Ignored> ignored;
    std::shared_ptr<const CameraTrack> cameraTrack;  // camera from a separate file; null: use the scene's own cameras
};

// Returns the material with this index; for −1, glTF's default material.
inline const Material& materialAt(const Scene& scene, int index) {
    static const Material gltfDefault;
    return index < 0 ? gltfDefault : scene.materials[static_cast<std::size_t>(index)];
}

}  // namespace defocus::engine
