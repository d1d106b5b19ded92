#pragma once
// A World on the GPU: meshes, textures and materials. Data are uploaded when a frame first uses them.

#include <array>
#include <compare>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "gl/pacer.h"
#include "gl/texture.h"
#include "plan/frame_plan.h"
#include "render/gpu_scene/gpu_mesh.h"

namespace defocus::engine {

// Textures of a material in the order of textureUses(); null if unused.
struct GpuMaterialTextures {
    std::array<const GlTexture*, materialTextureCount> slots{};
    auto operator<=>(const GpuMaterialTextures&) const = default;
    // Returns the index of a slot's texture among the material's used textures. `slot` is an index into textureUses().
    [[nodiscard]] int unit(std::size_t slot) const;
    [[nodiscard]] int count() const { return unit(materialTextureCount); }
    // Binds the textures to the units that shaders/include/material_textures.glsl reads.
    void attach() const;
};

class GpuScene {
public:
    // `pendingBytes`: max memory of pending triangles; see SubmissionPacer.
    explicit GpuScene(const World& world, std::uint64_t pendingBytes = SubmissionPacer::defaultBytes)
        : world_(&world), pacer_(pendingBytes) {}

    // Uploads data of `plan` that are not yet on the GPU. Throws Error if GPU memory is insufficient.
    void prepare(const FramePlan& plan);

    [[nodiscard]] const World& world() const { return *world_; }
    [[nodiscard]] SubmissionPacer& pacer() { return pacer_; }
    [[nodiscard]] const GpuMesh& mesh(int index) const { return meshes_[static_cast<std::size_t>(index)]; }
    [[nodiscard]] const GpuMaterialTextures& textures(int material) const {
        return *materialTextures_[static_cast<std::size_t>(material + 1)];
    }
    [[nodiscard]] const Material& material(int index) const { return materialAt(*world_->scene, index); }
    [[nodiscard]] std::size_t bytes() const;

private:
    void addMissing(std::size_t mesh, const std::vector<bool>& used, std::vector<MeshUpload>& missing);
    // Returns a texture, or nullptr if it is not used. With a cutoff > 0, the alpha of a texel in mip levels ≥ 1 is a
    // fraction: how many of the full-size texels that it covers have at least the cutoff as alpha (cut_out.h).
    const GlTexture* texture(const TextureUse& use, bool srgb, float cutoff = 0);
    // Uploads the textures that a material uses, if they are missing, and returns them.
    GpuMaterialTextures texturesOf(const Material& material);
    void prepareMaterial(int material);

    const World* world_;
    SubmissionPacer pacer_;
    std::vector<GpuMesh> meshes_;  // one per mesh of the world, without levels until a frame uses the mesh
    std::map<std::tuple<int, bool, float>, GlTexture> textures_;  // textures, keyed by the arguments of texture()
    std::set<GpuMaterialTextures> textureSets_;                   // distinct values of texturesOf()
    // Entry i: textures of material i − 1; entry 0: textures of the default material. Null if no frame has used the
    // material.
    std::vector<const GpuMaterialTextures*> materialTextures_;
};

}  // namespace defocus::engine
