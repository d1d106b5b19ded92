#pragma once
// Turns the records of a wave into light: lists them by the groups of surfaces that are shaded alike, then shades one
// group after the other, each with its material's textures, as a fragment of the other methods would be. Or, where
// vertices have light of their own (Tzeng et al. 2012), shades these beforehand and interpolates.

#include <map>
#include <string>

#include "render/lens_space/lens_front.h"

namespace defocus::engine {

class RecordShading {
public:
    RecordShading(GpuScene& scene, std::filesystem::path shaderFolder);

    // Programs and materials of the front's groups. `defines` are those of the front, the rays and the kernel.
    void prepare(const FramePlan& plan, const LensFront& front, const ShaderDefines& defines);
    // The light of the front's vertices, if they have light of their own. The frame's uniforms are bound.
    void shadeVertices(const LensFront& front);
    // Shades `count` records of the wave that begins at ray `firstRay`. Rays, records and the frame's uniforms are
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
    std::vector<const Program*> groupPrograms_;   // the sky's first
    std::vector<const Program*> vertexPrograms_;  // of the front's groups, where vertices have light of their own
    UniformBlocks<GpuMaterial> materials_;
    Buffer groups_, dispatches_, list_;
};

}  // namespace defocus::engine
