#pragma once
// Contents of a scene that a program builds in memory. Example:
//
//   const std::array<float, 3> corners[] = {{-1, 0, -3}, {1, 0, -3}, {0, 1, -3}};
//   const defocus::MeshData meshes[] = {{.name = "Sail", .positions = corners}};
//   const defocus::InstanceData instances[] = {{.mesh = 0}};
//   const defocus::Scene scene = defocus::Scene::create({.meshes = meshes, .instances = instances});
//
// Terms, defaults and ranges are those of glTF 2.0 and its extensions. Axes are right-handed with y up; cameras and
// lights look along −z. Lengths are in scene units, angles in radians, and colours in linear Rec.709. Scene::create
// copies all data: spans, views and pointers only need to be valid during the call.
//
// Every member has an initializer, so that compilers accept designated initializers for some of the members.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "defocus/camera.h"
#include "defocus/export.h"
#include "defocus/image.h"
#include "defocus/lens.h"

namespace defocus {

// 4 × 4 matrix in column-major order: elements 12, 13 and 14 are the translation, and the last row is 0, 0, 0, 1.
using Matrix4 = std::array<double, 16>;
inline constexpr Matrix4 identityMatrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

// Returns the transform of a camera or light at `position` that looks at `target`. Throws UsageError if the points are
// equal, if `up` is parallel to the line of sight, or if a value is NaN or infinite.
DEFOCUS_API Matrix4 lookAt(const Vector3& position, const Vector3& target, const Vector3& up = {0, 1, 0});

// Triangles with one material. Arrays of vertex attributes hold one element per vertex; optional arrays may be empty.
struct MeshData {
    std::string name = {};
    std::span<const std::array<float, 3>> positions = {};
    // Normals of any length > 0; a zero normal is replaced by a smooth normal of the adjacent faces. Default: flat
    // shading.
    std::span<const std::array<float, 3>> normals = {};
    std::span<const std::array<float, 2>> uvs = {};  // (0, 0) is the texture's top left corner, (1, 1) its bottom right
    std::span<const std::array<float, 4>> colors = {};  // RGBA in [0, 1], straight alpha; multiplies the base colour
    // Three indices into the arrays per triangle; front faces are counter-clockwise. Default: vertices 0, 1, 2, then 3,
    // 4, 5, and so on.
    std::span<const std::uint32_t> indices = {};
    int material = -1;  // index into SceneData::materials; −1: glTF's default material
};

enum class TextureContent {
    color,  // base colour, emission: linear Rec.709 with premultiplied alpha, like an Image
    data,   // metalness and roughness, normals, occlusion, transmission: linear values
};
enum class TextureWrap { repeat, clampToEdge, mirroredRepeat };
enum class TextureFilter { nearest, linear };

// An image with 1 (grey), 3 or 4 channels and values in [0, 1]. It is stored with 8 bits per channel; colours are
// stored in the sRGB encoding.
struct TextureData {
    std::string name = {};
    ImageView image = {};
    TextureContent content = TextureContent::color;
    // True: the alpha of `image` is straight, not premultiplied. Transparent pixels then keep their colour, which
    // matters at the edges of cut-outs. Textures with TextureContent::data always have straight alpha.
    bool straightAlpha = false;
    TextureWrap wrapU = TextureWrap::repeat;
    TextureWrap wrapV = TextureWrap::repeat;
    TextureFilter magnification = TextureFilter::linear;
    TextureFilter minification = TextureFilter::linear;
    bool mipmaps = true;
};

enum class AlphaMode {
    opaque,  // alpha is ignored
    mask,    // opaque where alpha is at least MaterialData::alphaCutoff, else invisible
    blend,   // alpha is coverage
};

// Metallic-roughness material. Texture values multiply the factors of the same name. Textures are indices into
// SceneData::textures; −1: none. Colour textures need TextureContent::color, data textures TextureContent::data.
struct MaterialData {
    std::string name = {};
    std::array<float, 4> baseColor = {1, 1, 1, 1};  // RGBA in [0, 1], straight alpha
    int baseColorTexture = -1;                      // colour texture
    float metallic = 1;                             // [0, 1]
    float roughness = 1;                            // [0, 1]
    int metallicRoughnessTexture = -1;              // data texture: roughness in G, metalness in B
    int normalTexture = -1;                         // data texture: (n + 1)/2 for the normal n in tangent space, +y up
    float normalScale = 1;                          // multiplies the x and y of the normals in normalTexture
    int occlusionTexture = -1;                      // data texture with occlusion in channel R
    float occlusionStrength = 1;                    // [0, 1]
    std::array<float, 3> emission = {0, 0, 0};      // emitted radiance, ≥ 0
    int emissionTexture = -1;                       // colour texture
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;  // ≥ 0
    bool doubleSided = false;
    bool unlit = false;  // true: the base colour is shown without lighting

    float ior = 1.5f;              // index of refraction, ≥ 1; 0: reflects all light
    float transmission = 0;        // fraction of light that passes through the surface, [0, 1]
    int transmissionTexture = -1;  // data texture with transmission in channel R
    float thickness = 0;           // thickness in mesh units, ≥ 0; 0: thin wall without refraction
    // Absorption: after attenuationDistance, white light has the colour attenuationColor.
    float attenuationDistance = std::numeric_limits<float>::infinity();  // distance > 0; +∞: no absorption
    std::array<float, 3> attenuationColor = {1, 1, 1};                   // [0, 1]
};

// An object of the scene: a mesh with a transform.
struct InstanceData {
    std::string name = {};  // name of the node. Default: the mesh's name
    int mesh = 0;           // index into SceneData::meshes
    Matrix4 transform = identityMatrix;
};

struct CameraData {
    std::string name = {};
    Matrix4 transform = identityMatrix;
    double yfov = 0.6911112;                   // vertical field of view, (0, π); unused if lens.focalLength is set
    double znear = 0.01;                       // depth of the near plane, > 0; nearer surfaces are invisible
    std::optional<double> focusDistance = {};  // distance along the view axis, > 0. Default: FocusAuto
    LensSettings lens = {};                    // units and defaults as in LensSettings; apertureImage must be empty
};

enum class LightType { directional, point, spot };

// A light of KHR_lights_punctual.
struct LightData {
    std::string name = {};
    LightType type = LightType::directional;
    Matrix4 transform = identityMatrix;      // placement of the light; the matrix's scale has no effect
    std::array<float, 3> color = {1, 1, 1};  // ≥ 0
    float intensity = 1;       // illuminance in lux (directional) or intensity in candela (point, spot), ≥ 0
    float range = 0;           // maximum distance of lit surfaces (point, spot); 0: unlimited
    float innerConeAngle = 0;  // spot light: angles from the axis, 0 ≤ inner < outer ≤ π/2
    float outerConeAngle = 0.785398163f;
    float angularDiameter = 0.00925f;  // angular size of a directional light, [0, π]; softens shadows
    float radius = 0.03f;              // radius of a point or spot light in m, ≥ 0; softens shadows
};

struct SceneData {
    std::string name = {};
    std::span<const MeshData> meshes = {};
    std::span<const MaterialData> materials = {};
    std::span<const TextureData> textures = {};
    std::span<const InstanceData> instances = {};  // objects, at least one
    std::span<const CameraData> cameras = {};      // cameras; empty: a camera that frames the scene
    std::span<const LightData> lights = {};        // lights; empty: studio lights
    double metresPerUnit = 1;                      // metres per scene unit, 1e-9 … 1e9
};

}  // namespace defocus
