#pragma once
// A World on the GPU: vertex and index buffers of the pyramid levels that frames use, textures and materials of the
// meshes that are drawn. What no plan has asked for is never uploaded.

#include <array>
#include <glm/vec4.hpp>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/bounds.h"
#include "gl/buffer.h"
#include "gl/texel_buffer.h"
#include "gl/texture.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

// Vertex attribute locations of shaders/accumulation/object.vert.
enum AttributeLocation : unsigned {
    positionLocation,
    normalLocation,
    colorLocation,
    uv0Location,
    uv1Location,
    tangentLocation,
    lensLocation,
    eyeLocation,
    blurLocation,
    jointsLocation,
    weightsLocation,
    joints1Location,
    weights1Location,
    momentLocation,
    bandShiftLocation,
    colorRangeLocation,  // the last of the 16 that every driver has
};

// A level's place in the mesh's buffers.
struct GpuLevel {
    bool uploaded = false;
    GLenum colorType = GL_UNSIGNED_SHORT;   // of the colours' four components: normalised shorts, or half floats
    std::size_t vectorOffset = 0;           // bytes into the positions and the normals buffer
    std::size_t colorOffset = 0;            // bytes into the colours buffer
    std::size_t uvOffset = 0;               // bytes into the buffer of either set of texture coordinates
    std::vector<std::size_t> indexOffsets;  // bytes into the index buffer, one a primitive
    glm::vec4 minColor{0.0f};               // of the level's vertices, 1 is white
    glm::vec4 maxColor{0.0f};
};

// What moves a mesh's vertices against each other; empty where the mesh doesn't have it.
struct GpuDeformation {
    Buffer joints, weights, joints1, weights1;
    TexelBuffer morphs;  // RGB32F; target after target: positions, then normals, then tangents
    bool morphNormals = false;
    bool morphTangents = false;
    std::size_t vertexCount = 0;  // texels an attribute of a target
    [[nodiscard]] int attributesPerTarget() const { return 1 + (morphNormals ? 1 : 0) + (morphTangents ? 1 : 0); }
};

struct GpuMesh {
    glm::dvec3 origin{0.0};  // object units; positions in the buffers are relative to it
    VertexArray vertexArray;
    Buffer positions, normals, colors, colorRanges, uv0, uv1, tangents, blurs, indices;
    GpuDeformation deformation;
    std::vector<GpuLevel> levels;
};

// Where the positions of a mesh are best measured from: 0 along an axis where the box lies near its own origin, else
// its middle. Single precision then holds the shape of what lies far away, and p − origin loses nothing: the axes that
// are moved have every p between half and twice the origin (Sterbenz 1974, Floating-Point Computation).
glm::dvec3 meshOrigin(const Bounds& bounds);
// Makes the vertex array read the level's vertices.
void bindLevel(GpuMesh& mesh, std::size_t level);

// A material's textureUses on the GPU; null where there is none.
struct GpuMaterialTextures {
    const GlTexture* slots[materialTextureCount] = {};
    // Where surface_shading.glsl reads them.
    void attach() const;
};

// For each of `colors`, the range over all triangles that it is a corner of: of each channel, 256 times the most plus
// the least, in 1/255 and rounded outwards. `indices`: triangles.
std::vector<glm::u16vec4> cornerColorRanges(const std::vector<glm::vec4>& colors,
                                            std::span<const std::uint32_t> indices);

// A material's uniform block of shaders/include/frame.glsl, std140.
struct GpuMaterial {
    glm::vec4 baseColor;
    glm::vec4 emissiveCutoff;
    glm::vec4 surface;
    glm::vec4 reflectance;
    glm::vec4 transmission;
    glm::vec4 absorption;
    glm::vec4 coat;
    glm::vec4 sheen;
    std::array<glm::vec4, 2 * materialTextureCount> uvRows;
};

class GpuScene {
public:
    explicit GpuScene(const World& world) : world_(&world) {}

    // Uploads what `plan` draws and isn't there yet. Throws Error when graphics memory runs out.
    void prepare(const FramePlan& plan);

    [[nodiscard]] const World& world() const { return *world_; }
    [[nodiscard]] GpuMesh& mesh(int index) { return meshes_.at(index); }
    [[nodiscard]] const GpuMaterialTextures& textures(int material) const { return materialTextures_.at(material); }
    [[nodiscard]] const Material& material(int index) const;
    [[nodiscard]] std::size_t bytes() const;

    [[nodiscard]] GpuMaterial materialBlock(int material) const;

private:
    void prepareObjects(const FramePlan& plan, const std::vector<ObjectPlan>& objects);
    void uploadDeformation(int mesh, std::size_t vertexCount, GpuMesh& target);
    void uploadMesh(int mesh, const std::vector<bool>& levels);
    const GlTexture* texture(const TextureUse& use, bool srgb);
    void prepareMaterial(int material);

    const World* world_;
    std::map<int, GpuMesh> meshes_;
    std::map<std::pair<int, bool>, GlTexture> textures_;  // by texture and whether it is sRGB
    std::map<int, GpuMaterialTextures> materialTextures_;
};

}  // namespace defocus::engine
