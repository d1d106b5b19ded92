#pragma once
// Shades the records (ray hits) of a batch (wave) of rays. Records are grouped by surfaces with the same program and
// material (ShadedGroup), and each group is shaded like fragments in other methods. With per-vertex lighting (Tzeng et
// al. 2012), vertices are shaded first, and their radiance is interpolated.

#include <map>
#include <string>

#include "render/gpu_scene/material_blocks.h"
#include "render/lens_space/lens_front.h"

namespace defocus::engine {

class RecordShading {
public:
    RecordShading(GpuScene& scene, std::filesystem::path shaderFolder);

    // Prepares programs and materials for the groups of surfaces of `front`. `defines`: preprocessor macros that
    // shaders need to read the triangles (LensFront::defines) and the rays (VisibilityKernel::rayDefines, rayVariants).
    void prepare(const FramePlan& plan, const LensFront& front, const ShaderDefines& defines);
    // With per-vertex lighting, shades the vertices of `front`; otherwise does nothing. The frame's uniforms must be
    // bound.
    void shadeVertices(const LensFront& front);
    // Shades `count` records (ray hits) of the batch of rays that starts at ray `firstRay`. Rays, records and the
    // frame's uniforms must be bound.
    void shade(const LensFront& front, std::uint64_t count, std::uint32_t firstRay);
    // Binds the textures and the uniforms of the material of LensFront::groups()[group].
    void bindMaterial(std::size_t group) const { materials_.bind(group); }
    [[nodiscard]] std::size_t bytes() const;

private:
    const Program& program(const char* shader, const ShaderDefines& defines, const ShaderDefines& more);

    GpuScene* scene_;
    std::filesystem::path shaderFolder_;
    glm::ivec2 imageSize_{0};
    float lensRadius_ = 0;  // m
    std::map<std::string, Program> programs_;
    ShaderDefines listDefines_;
    Program countProgram_, listProgram_, placesProgram_;
    std::vector<const Program*> groupPrograms_;   // program 0 shades the sky, program i surface group i − 1
    std::vector<const Program*> vertexPrograms_;  // one program per surface group; empty without per-vertex lighting
    MaterialBlocks materials_;
    Buffer groups_, dispatches_, list_;
};

}  // namespace defocus::engine
