#pragma once
// Uploads meshes to the GPU. Small meshes with the same attributes share buffers, because separate buffers take more
// time and memory than the vertices of a small mesh.

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/bounds.h"
#include "gl/buffer.h"
#include "gl/texel_buffer.h"
#include "plan/view.h"
#include "render/gpu_scene/vertex_format.h"

namespace defocus::engine {

// Buffers of one or more meshes.
struct MeshBuffers {
    std::array<Buffer, attributeLocationCount> vertices;  // vertex buffers, indexed by AttributeLocation
    Buffer indices;
    [[nodiscard]] std::size_t bytes() const;
};

// Position of a pyramid level's data in the mesh's buffers.
struct GpuLevel {
    bool uploaded = false;
    GLenum colorType = GL_UNSIGNED_SHORT;  // type of the four colour components: normalised shorts or half floats
    std::size_t firstVertex = 0;           // index of the level's first vertex in per-level buffers
    std::size_t firstIndex = 0;            // offset of the level's indices in the index buffer
    glm::vec4 minColor{0.0f};              // min of the level's vertex colours per channel; 1 is white
    glm::vec4 maxColor{0.0f};
};

// Morph targets of a mesh; empty for meshes without them.
struct GpuMorphs {
    TexelBuffer texels;  // RGB32F; per target: displacements of positions, then normals, then tangents
    bool normals = false;
    bool tangents = false;
    std::size_t vertexCount = 0;  // number of vertices, which is the number of texels per attribute of a morph target
    [[nodiscard]] int attributesPerTarget() const { return 1 + (normals ? 1 : 0) + (tangents ? 1 : 0); }
    explicit operator bool() const { return static_cast<bool>(texels); }
};

struct GpuMesh {
    glm::dvec3 origin{0.0};  // object units; positions in the buffer are relative to this point
    AttributeSet attributes = 0;
    std::shared_ptr<const MeshBuffers> buffers;
    std::size_t firstVertex = 0;  // index of the first vertex in the buffers shared by all levels
    GpuMorphs morphs;
    std::vector<GpuLevel> levels;
    [[nodiscard]] bool has(AttributeLocation location) const { return (attributes & only(location)) != 0; }
};

// Mesh to upload, with one flag per level of detail: true for levels that frames need.
struct MeshUpload {
    std::size_t mesh = 0;
    std::vector<bool> levels;
};

// Uploads meshes of `world`, and replaces their entries in `meshes`.
void uploadMeshes(const World& world, std::span<const MeshUpload> uploads, std::vector<GpuMesh>& meshes);

// Returns the point to which a mesh's positions in the buffer are relative: per axis 0 if the bounding box is near 0,
// else the box's centre. Thus single precision suffices for meshes far from their origin. On axes where the point is
// not 0, position − point is exact, because the position is between half and twice the point (Sterbenz 1974,
// Floating-Point Computation).
glm::dvec3 meshOrigin(const Bounds& bounds);

// Returns, for each vertex, the range of the vertex colours of all triangles at this vertex; `indices` is a triangle
// list. Each channel is 256 · max + min. Both are in units of 1/255, with max rounded up and min rounded down.
std::vector<glm::u16vec4> cornerColorRanges(const std::vector<glm::vec4>& colors,
                                            std::span<const std::uint32_t> indices);

}  // namespace defocus::engine
