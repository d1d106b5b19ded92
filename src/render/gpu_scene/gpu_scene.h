#pragma once
// A World on the GPU: vertex and index buffers of pyramid levels, and textures and materials. Data are uploaded when a
// frame first uses them.

#include <array>
#include <glm/vec4.hpp>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "core/bounds.h"
#include "gl/buffer.h"
#include "gl/pacer.h"
#include "gl/texel_buffer.h"
#include "gl/texture.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

// Vertex attribute locations of vertex.glsl, posing.glsl and surface_vertex.glsl in shaders/include/.
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
    colorRangeLocation,  // location 15, the highest that all drivers support
};

// Position of a pyramid level's data in the mesh's buffers.
struct GpuLevel {
    bool uploaded = false;
    GLenum colorType = GL_UNSIGNED_SHORT;   // type of the four colour components: normalised shorts or half floats
    std::size_t vectorOffset = 0;           // byte offset in the buffers `positions` and `normals`
    std::size_t colorOffset = 0;            // byte offset in the buffer `colors`
    std::size_t uvOffset = 0;               // byte offset in the buffers `uv0` and `uv1`
    std::vector<std::size_t> indexOffsets;  // byte offset in the index buffer, per primitive
    glm::vec4 minColor{0.0f};               // min of the level's vertex colours per channel; 1 is white
    glm::vec4 maxColor{0.0f};
};

// Skinning and morphing data of a mesh; empty for meshes without skin and morph targets.
struct GpuDeformation {
    Buffer joints, weights, joints1, weights1;
    TexelBuffer morphs;  // RGB32F; per target: displacements of positions, then normals, then tangents
    bool morphNormals = false;
    bool morphTangents = false;
    std::size_t vertexCount = 0;  // number of texels per attribute of a target
    [[nodiscard]] int attributesPerTarget() const { return 1 + (morphNormals ? 1 : 0) + (morphTangents ? 1 : 0); }
};

struct GpuMesh {
    glm::dvec3 origin{0.0};  // object units; positions in the buffer are relative to this point
    VertexArray vertexArray;
    Buffer positions, normals, colors, colorRanges, uv0, uv1, tangents, blurs, indices;
    GpuDeformation deformation;
    std::vector<GpuLevel> levels;
};

// Returns the point to which a mesh's positions in the buffer are relative: per axis 0 if the bounding box is near 0,
// else the box's centre. Thus single precision suffices for meshes far from their origin. On axes with an offset, p −
// origin is exact, because p is between half and twice the origin (Sterbenz 1974, Floating-Point Computation).
glm::dvec3 meshOrigin(const Bounds& bounds);
// Binds the vertices of a level to the mesh's vertex array.
void bindLevel(GpuMesh& mesh, std::size_t level);

// Textures of a material in the order of textureUses(); null if unused.
struct GpuMaterialTextures {
    const GlTexture* slots[materialTextureCount] = {};
    // Returns the index of a slot's texture among the material's textures.
    [[nodiscard]] int unit(std::size_t slot) const;
    [[nodiscard]] int count() const { return unit(materialTextureCount); }
    // Binds the textures to the units that shaders/include/material_textures.glsl reads.
    void attach() const;
};

// Returns for each vertex the range of the vertex colours of all triangles at this vertex; `indices` is a triangle
// list. Each channel is 256 · max + min, with max and min in 1/255, rounded outwards.
std::vector<glm::u16vec4> cornerColorRanges(const std::vector<glm::vec4>& colors,
                                            std::span<const std::uint32_t> indices);

// Uniform block of a material; matches shaders/include/frame.glsl (std140).
struct GpuMaterial {
    glm::vec4 baseColor;
    glm::vec4 emissiveCutoff;
    glm::vec4 surface;
    glm::vec4 reflectance;
    glm::vec4 transmission;
    glm::vec4 absorption;
    glm::vec4 coat;
    glm::vec4 sheen;
    glm::vec4 anisotropy;
    glm::vec4 film;
    glm::vec4 through;
    std::array<glm::vec4, 2 * materialTextureCount> uvRows;
};

class GpuScene {
public:
    // `pendingBytes`: see SubmissionPacer.
    explicit GpuScene(const World& world, std::uint64_t pendingBytes = SubmissionPacer::defaultBytes)
        : world_(&world), pacer_(pendingBytes) {}

    // Uploads data of `plan` that are not yet on the GPU. Throws Error if GPU memory is insufficient.
    void prepare(const FramePlan& plan);

    [[nodiscard]] const World& world() const { return *world_; }
    [[nodiscard]] SubmissionPacer& pacer() { return pacer_; }
    [[nodiscard]] GpuMesh& mesh(int index) { return meshes_.at(index); }
    [[nodiscard]] const GpuMaterialTextures& textures(int material) const { return materialTextures_.at(material); }
    [[nodiscard]] const Material& material(int index) const;
    [[nodiscard]] std::size_t bytes() const;

    [[nodiscard]] GpuMaterial materialBlock(int material) const;

private:
    void prepareObjects(const FramePlan& plan, const std::vector<ObjectPlan>& objects);
    void uploadDeformation(int mesh, std::size_t vertexCount, GpuMesh& target);
    void uploadMesh(int mesh, const std::vector<bool>& levels);
    // Returns a texture, or nullptr if it is not used. With a cutoff > 0, mip levels ≥ 1 hold in alpha the fraction of
    // their full-size texels whose alpha is at least the cutoff (cut_out.h).
    const GlTexture* texture(const TextureUse& use, bool srgb, float cutoff = 0);
    void prepareMaterial(int material);

    const World* world_;
    SubmissionPacer pacer_;
    std::map<int, GpuMesh> meshes_;
    std::map<std::tuple<int, bool, float>, GlTexture> textures_;  // key: the arguments of texture()
    std::map<int, GpuMaterialTextures> materialTextures_;
};

}  // namespace defocus::engine
