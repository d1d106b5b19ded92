#pragma once
// Shades the records of a wave. The records are listed by group of surfaces with the same shading. Each group is then
// shaded with its material's textures, like a fragment of the other methods. With per-vertex lighting (Tzeng et al.
// 2012), vertices are shaded beforehand and their light is interpolated.

#include <map>
#include <string>

#include "render/lens_space/lens_front.h"

namespace defocus::engine {

class RecordShading {
public:
    RecordShading(GpuScene& scene, std::filesystem::path shaderFolder);

    // Prepares the programs and materials of the front end's groups. `defines`: those of the front end, the rays and
    // the kernel.
    void prepare(const FramePlan& plan, const LensFront& front, const ShaderDefines& defines);
    // Shades the front end's vertices if lighting is per vertex. The frame's uniforms must be bound.
    void shadeVertices(const LensFront& front);
    // Shades `count` records of the wave that begins at ray `firstRay`. Rays, records and the frame's uniforms must be
    // bound.
    void shade(const LensFront& front, std::uint64_t count, std::uint32_t firstRay);
    [[nodiscard]] std::size_t bytes() const;

private:
    const Program& program(const char* shader, const ShaderDefines& defines, const ShaderDefines& more);
    void bindMaterial(const LensFront& front, std::size_t group) const;

    GpuScene* scene_;
    std::filesystem::path shaderFolder_;
    glm::ivec2 imageSize_{0};
    float lensRadius_ = 0;  // m
    std::map<std::string, Program> programs_;
    ShaderDefines listDefines_;
    Program countProgram_, listProgram_, placesProgram_;
    std::vector<const Program*> groupPrograms_;   // the sky's program first
    std::vector<const Program*> vertexPrograms_;  // one per group, with per-vertex lighting only
    UniformBlocks<GpuMaterial> materials_;
    Buffer groups_, dispatches_, list_;
};

}  // namespace defocus::engine
