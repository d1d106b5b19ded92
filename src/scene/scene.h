#pragma once
// A scene as read from a file or made by a generator: plain data, in glTF 2.0's terms. Nothing here knows of the GPU.
// Units: metres, radians, linear Rec.709; right-handed, y up, cameras look along -z.

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

#include "image/image.h"
#include "scene/camera.h"
#include "scene/mesh.h"

namespace defocus::engine {

// ---- materials ----------------------------------------------------------------------------------

enum class Wrap { repeat, clampToEdge, mirroredRepeat };
enum class Filter { nearest, linear };

struct Texture {
    int image = -1;  // into Scene::images
    Wrap wrapS = Wrap::repeat;
    Wrap wrapT = Wrap::repeat;
    Filter magnification = Filter::linear;
    Filter minification = Filter::linear;
    bool mipmaps = true;
};

struct TextureUse {
    int texture = -1;             // into Scene::textures; -1: none
    int uvSet = 0;                // 0 or 1
    glm::mat3 uvTransform{1.0f};  // KHR_texture_transform: uv' = (uvTransform · (u, v, 1)).xy
    [[nodiscard]] bool used() const { return texture >= 0; }
};

enum class AlphaMode { opaque, mask, blend };

struct Material {
    std::string name;
    glm::vec4 baseColorFactor{1.0f};  // linear, straight alpha
    float metallicFactor = 1.0f;
    float roughnessFactor = 1.0f;
    glm::vec3 emissiveFactor{0.0f};  // KHR_materials_emissive_strength multiplied in
    float normalScale = 1.0f;
    float occlusionStrength = 1.0f;
    TextureUse baseColor;          // sRGB
    TextureUse metallicRoughness;  // linear; G roughness, B metallic
    TextureUse normal;             // linear, tangent space, +y up
    TextureUse occlusion;          // linear; R
    TextureUse emissive;           // sRGB
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;  // AlphaMode::mask
    bool doubleSided = false;
    bool unlit = false;  // KHR_materials_unlit

    // KHR_materials_ior and KHR_materials_specular, of what isn't metal.
    float ior = 1.5f;  // ≥ 1; 0: it mirrors everything
    float specularFactor = 1.0f;
    glm::vec3 specularColorFactor{1.0f};
    TextureUse specular;       // linear; A
    TextureUse specularColor;  // sRGB

    // KHR_materials_transmission and KHR_materials_volume.
    float transmissionFactor = 0.0f;
    TextureUse transmission;       // linear; R
    float thicknessFactor = 0.0f;  // object units along the refracted ray; 0: a thin wall, which doesn't refract
    TextureUse thickness;          // linear; G
    float attenuationDistance = std::numeric_limits<float>::infinity();  // scene units, to `attenuationColor`
    glm::vec3 attenuationColor{1.0f};

    // KHR_materials_clearcoat.
    float clearcoatFactor = 0.0f;
    float clearcoatRoughnessFactor = 0.0f;
    float clearcoatNormalScale = 1.0f;
    TextureUse clearcoat;           // linear; R
    TextureUse clearcoatRoughness;  // linear; G
    TextureUse clearcoatNormal;     // as `normal`; without one the coat is as smooth as the mesh

    // KHR_materials_sheen.
    glm::vec3 sheenColorFactor{0.0f};
    float sheenRoughnessFactor = 0.0f;
    TextureUse sheenColor;      // sRGB
    TextureUse sheenRoughness;  // linear; A

    // Shows what lies behind it.
    [[nodiscard]] bool transmits() const { return !unlit && transmissionFactor > 0; }
    // What isn't metal reflects otherwise than glTF's 4 %.
    [[nodiscard]] bool hasOwnReflectance() const {
        return !unlit && (ior != 1.5f || specularFactor != 1 || specularColorFactor != glm::vec3(1) ||
                          specular.used() || specularColor.used());
    }
    [[nodiscard]] bool hasClearcoat() const { return !unlit && clearcoatFactor > 0; }
    [[nodiscard]] bool hasSheen() const { return !unlit && sheenColorFactor != glm::vec3(0); }
};

inline constexpr std::size_t materialTextureCount = 14;

// All textures of a material; the shaders (surface_shading.glsl) know them by these places.
inline std::array<const TextureUse*, materialTextureCount> textureUses(const Material& m) {
    return {&m.baseColor,          &m.metallicRoughness, &m.normal,       &m.occlusion,     &m.emissive,
            &m.specular,           &m.specularColor,     &m.transmission, &m.thickness,     &m.clearcoat,
            &m.clearcoatRoughness, &m.clearcoatNormal,   &m.sheenColor,   &m.sheenRoughness};
}

// ---- lights and surroundings --------------------------------------------------------------------

enum class LightType { directional, point, spot };

struct Light {  // KHR_lights_punctual
    std::string name;
    LightType type = LightType::directional;
    glm::vec3 color{1.0f};
    float intensity = 1.0f;       // lux (directional) or candela (point, spot)
    float range = 0.0f;           // m; 0: unlimited
    float innerConeAngle = 0.0f;  // rad
    float outerConeAngle = 0.785398163f;
    // What casts soft shadows: a disk that faces whatever it shines on. glTF knows no sizes; these are the sun's and
    // that of a bulb.
    float angularDiameter = 0.00925f;  // rad, of a directional light
    float radius = 0.03f;              // m, of a point or spot light
};

// What lies behind everything and lights it from all around. Radiance L(d) for a direction d with d.y up.
enum class EnvironmentType {
    none,      // black and transparent: alpha is the coverage of the geometry
    uniform,   // L = zenith everywhere
    gradient,  // L = mix(horizon, zenith, d.y) above, mix(horizon, nadir, -d.y) below
    map,       // equirectangular HDR image; its centre column lies at -z, its right half at +x
};

struct Environment {
    EnvironmentType type = EnvironmentType::gradient;
    glm::vec3 zenith{0.0f};
    glm::vec3 horizon{0.0f};
    glm::vec3 nadir{0.0f};
    std::shared_ptr<const Image> map;  // EnvironmentType::map; NaN is black
    bool visible = true;    // false: it lights the surfaces, but behind them is nothing (alpha is their coverage)
    float lighting = 1.0f;  // scales the light it throws on surfaces (its own look stays)
};

// ---- hierarchy and animation --------------------------------------------------------------------

struct Node {
    std::string name;
    int parent = -1;
    std::vector<int> children;
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
    std::optional<glm::dmat4> matrix;  // replaces translation, rotation, scale (never animated then)
    int mesh = -1;
    int skin = -1;
    int camera = -1;
    int light = -1;
    std::vector<float> morphWeights;
    double cocScale = 1;                // factor on the blur of its subtree (extras), ≥ 0; 0: always sharp
    bool ground = false;                // its mesh belongs to the surroundings (scene/ground.h)
    std::vector<glm::dmat4> instances;  // EXT_mesh_gpu_instancing: the mesh is drawn once for each, in the node's space
};

struct Skin {
    std::string name;
    std::vector<int> joints;                     // node indices
    std::vector<glm::mat4> inverseBindMatrices;  // as many as joints
};

enum class Interpolation { step, linear, cubicSpline };
enum class ChannelPath {
    translation,  // of a node, as the next three
    rotation,
    scale,
    weights,
    cameraYfov,   // radians; of a camera (KHR_animation_pointer), as the next two
    cameraZnear,  // m
    cameraLens,   // the value `lensValue` of Camera::lens
    lightColor,   // of a light (KHR_animation_pointer), as the next two
    lightIntensity,
    lightRange,  // m
};

struct AnimationChannel {
    int target = -1;  // by its path: into Scene::nodes, Scene::cameras or Scene::lights
    ChannelPath path = ChannelPath::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;   // seconds, increasing
    std::vector<float> values;  // 3, 4, (targets) or 1 floats a key; cubicSpline: in-tangent, value, out-tangent
    std::string lensValue;      // ChannelPath::cameraLens
};

struct AnimationClip {
    std::string name;
    std::vector<AnimationChannel> channels;
    float duration = 0.0f;  // seconds, the last key
};

// Something in the file that is not drawn, and why; `count` equal things in one entry.
struct Ignored {
    std::string what;
    std::string reason;
    std::uint64_t count = 1;
    bool damage = false;  // a fault of the file, worth a warning, not something that is only not drawn
};

struct Scene {
    std::string name;
    std::filesystem::path file;  // that it was read from; empty: none
    std::vector<Mesh> meshes;
    std::vector<Material> materials;  // a primitive's material -1 is glTF's default material
    std::vector<Texture> textures;
    std::vector<TextureImage> images;
    std::vector<std::string> imageNames;  // as many as images
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::vector<Node> nodes;  // of the chosen glTF scene and everything joints need
    std::vector<int> roots;
    std::vector<Skin> skins;
    std::vector<AnimationClip> clips;
    std::optional<Environment> environment;  // none given: see withDefaults
    double metresPerUnit = 1;                // of all lengths above; poses are in metres
    std::optional<double>
        ownMetresPerUnit;                 // as the file itself says (extras); else it is only believed to hold metres
    std::vector<std::string> extensions;  // used by the file, sorted
    std::vector<Ignored> ignored;
};

}  // namespace defocus::engine
