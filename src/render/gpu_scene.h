#pragma once
// A World on the GPU: vertex and index buffers of the pyramid levels that frames use, textures and materials of the
// meshes that are drawn. What no plan has asked for is never uploaded.

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "gl/buffer.h"
#include "gl/texel_buffer.h"
#include "gl/texture.h"
#include "plan/frame_plan.h"
#include "render/gpu_blocks.h"

namespace defocus {

// A level's place in the mesh's buffers.
struct GpuLevel {
    bool uploaded = false;
    std::size_t vectorOffset = 0;           // bytes into the positions and the normals buffer
    std::size_t colorOffset = 0;            // bytes into the colours buffer
    std::vector<std::size_t> indexOffsets;  // bytes into the index buffer, one a primitive
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
    VertexArray vertexArray;
    Buffer positions, normals, colors, uv0, uv1, tangents, cocScales, indices;
    GpuDeformation deformation;
    std::vector<GpuLevel> levels;
};

// A material's textures in the order of the shader's bindings.
std::array<const TextureUse*, 5> textureUses(const Material& material);

// The same on the GPU; null where there is none.
struct GpuMaterialTextures {
    const GlTexture* slots[5] = {};
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

    [[nodiscard]] static GpuMaterial materialBlock(const Material& material);

private:
    void uploadDeformation(int mesh, std::size_t vertexCount, GpuMesh& target);
    void uploadMesh(int mesh, const std::vector<bool>& levels);
    const GlTexture* texture(const TextureUse& use, bool srgb);
    void prepareMaterial(int material);

    const World* world_;
    std::map<int, GpuMesh> meshes_;
    std::map<std::pair<int, bool>, GlTexture> textures_;  // by texture and whether it is sRGB
    std::map<int, GpuMaterialTextures> materialTextures_;
};

}  // namespace defocus
