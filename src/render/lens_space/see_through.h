#pragma once
// Lets rays of the lens-space methods pass through cut-out and alpha-blended surfaces. After the visibility kernel has
// found the hits, each ray that hits such a surface stops there or goes on, depending on alpha at the hit
// (shaders/lens_space/let_through.comp). Rays that go on find their next hit (behind.comp), until all rays have
// stopped.
//
// Behind such a surface, a line sample continues as point samples, one from each shading point on the surface. This
// approximation is not published: Tzeng et al. 2012 draw only opaque surfaces.

#include "render/lens_space/lens_front.h"
#include "render/lens_space/record_shading.h"

namespace defocus::engine {

class SeeThrough {
public:
    SeeThrough(std::filesystem::path shaderFolder, std::uint32_t tileSize);

    // Prepares the programs for the groups of surfaces of `front`. `defines`: preprocessor macros that shaders need to
    // read the triangles (LensFront::defines) and the rays (VisibilityKernel::rayDefines, rayVariants).
    void prepare(const FramePlan& plan, const LensFront& front, const ShaderDefines& defines);
    // Updates the `count` records (ray hits) of the batch of rays that starts at ray `firstRay`: moves each hit to the
    // surface at which its ray stops. The rays, the records and the frame's uniforms must be bound. Returns the number
    // of searches for a next hit. Throws Error if a tile's triangle list is too long for the driver to search in one
    // dispatch.
    std::uint64_t resolve(LensFront& front, const RecordShading& shading, std::uint64_t count, std::uint32_t firstRay);

private:
    struct Test {
        std::size_t group = 0;  // index in LensFront::groups()
        const Program* program = nullptr;
    };

    [[nodiscard]] std::uint32_t raysThatGoOn(const LensFront& front, const RecordShading& shading, std::uint64_t count,
                                             std::uint32_t firstRay, bool first);

    std::filesystem::path shaderFolder_;
    std::uint32_t tileSize_;
    glm::ivec2 imageSize_{0};
    std::map<std::string, Program> programs_;
    std::vector<Test> tests_;
    const Program* behind_ = nullptr;
    Buffer goOn_;
};

}  // namespace defocus::engine
