#pragma once
// A World on the GPU: vertex and index buffers of the pyramid levels that frames use, and textures and materials of the
// drawn meshes. Data are uploaded when a plan first uses them.

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

// Vertex attribute locations of shaders/include/vertex.glsl and surface_vertex.glsl.
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
    colorRangeLocation,  // location 15: every driver has at least 16
};

// Position of a level's data in the mesh's buffers.
struct GpuLevel {
    bool uploaded = false;
    GLenum colorType = GL_UNSIGNED_SHORT;   // type of the colours' four components: normalised shorts or half floats
    std::size_t vectorOffset = 0;           // bytes, in the position and normal buffers
    std::size_t colorOffset = 0;            // bytes, in the colour buffer
    std::size_t uvOffset = 0;               // bytes, in the buffers of both texture coordinate sets
    std::vector<std::size_t> indexOffsets;  // bytes, in the index buffer; one offset per primitive
    glm::vec4 minColor{0.0f};               // min of the level's vertex colours; 1 is white
    glm::vec4 maxColor{0.0f};
};

// Skinning and morphing data of a mesh; empty for rigid meshes.
struct GpuDeformation {
    Buffer joints, weights, joints1, weights1;
    TexelBuffer morphs;  // RGB32F; for each target: positions, then normals, then tangents
    bool morphNormals = false;
    bool morphTangents = false;
    std::size_t vertexCount = 0;  // texels per attribute of a target
    [[nodiscard]] int attributesPerTarget() const { return 1 + (morphNormals ? 1 : 0) + (morphTangents ? 1 : 0); }
};

struct GpuMesh {
    glm::dvec3 origin{0.0};  // object units; buffer positions are relative to it
    VertexArray vertexArray;
    Buffer positions, normals, colors, colorRanges, uv0, uv1, tangents, blurs, indices;
    GpuDeformation deformation;
    std::vector<GpuLevel> levels;
};

// Returns the origin for a mesh's buffer positions: per axis 0 if the bounding box lies near its own origin, else the
// box's centre. Single precision then keeps the shape of distant meshes. The subtraction p − origin is exact, since p
// lies between half and twice the origin on shifted axes (Sterbenz 1974, Floating-Point Computation).
glm::dvec3 meshOrigin(const Bounds& bounds);
// Points the vertex array at the level's vertices.
void bindLevel(GpuMesh& mesh, std::size_t level);

// Textures of a material, in the order of textureUses(); null for unused slots.
struct GpuMaterialTextures {
    const GlTexture* slots[materialTextureCount] = {};
    // Returns the index of a slot's texture among the material's textures.
    [[nodiscard]] int unit(std::size_t slot) const;
    [[nodiscard]] int count() const { return unit(materialTextureCount); }
    // Binds the textures to the units that shaders/include/material_textures.glsl reads.
    void attach() const;
};

// Returns, for each vertex colour, the range over all triangles at this vertex. Each channel is 256 · max + min, both
// in 1/255 and rounded outwards. `indices`: triangle list.
std::vector<glm::u16vec4> cornerColorRanges(const std::vector<glm::vec4>& colors,
                                            std::span<const std::uint32_t> indices);

// Uniform block of a material, as in shaders/include/frame.glsl, std140.
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

    // Uploads the data of `plan` that are not on the GPU yet. Throws Error when graphics memory runs out.
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
    std::map<std::pair<int, bool>, GlTexture> textures_;  // keyed by texture index and whether it is sRGB
    std::map<int, GpuMaterialTextures> materialTextures_;
};

}  // namespace defocus::engine
