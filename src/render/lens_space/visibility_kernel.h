#pragma once
// Interface for the part in which the lens-space methods differ: the choice of rays and the search for their hits.

#include "render/lens_space/lens_front.h"
#include "render/lens_space/ray_sets.h"
#include "render/renderer.h"

namespace defocus::engine {

// Bytes of a record (ray hit) in shaders/lens_space/records.glsl.
inline constexpr std::size_t recordBytes = 4 * sizeof(std::uint32_t);

// Batch (wave) of rays that are traced together: rays [first, first + count) of each pixel.
struct RayWave {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

class VisibilityKernel {
public:
    virtual ~VisibilityKernel() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    [[nodiscard]] virtual std::uint32_t tileSize() const = 0;  // tile side in px
    // Returns whether lighting is computed at vertices and interpolated; otherwise it is computed at the hits.
    [[nodiscard]] virtual bool lightsVertices() const = 0;
    // Returns the rays for a plan. Throws Error if the method cannot draw the plan.
    [[nodiscard]] virtual RaySets raySets(const FramePlan& plan, std::uint32_t partsOfExposure) const = 0;
    // Returns the defines, other than rayVariants, of shaders that read rays and records (ray hits).
    [[nodiscard]] virtual ShaderDefines rayDefines() const = 0;
    // Returns the path of the shader that adds the shaded records (hits) of each pixel's rays.
    [[nodiscard]] virtual const char* addShader() const { return "lens_space/add.comp"; }
    // Returns the expected size in bytes of one ray's records (hits), which limits the number of rays per batch.
    [[nodiscard]] virtual std::uint64_t rayBytes() const = 0;
    // Prepares a frame; called before the frame's first rays are traced. `defines`: preprocessor macros that shaders
    // need to read the triangles (LensFront) and the rays (RaySets).
    virtual void start(const FramePlan& plan, const RaySets& rays, const ShaderDefines& defines) = 0;
    // Finds the hits of a batch (wave) of rays and returns their number. Reduces `wave.count` if the records of the
    // hits would exceed the max buffer size. The frame's uniforms and the rays must be bound.
    virtual std::uint64_t find(LensFront& front, RayWave& wave) = 0;
    // Binds the records (ray hits) for shaders/lens_space/, and for line samples also the range of records of each
    // line.
    virtual void bindRecords() const = 0;
    virtual void addTo(RenderStats& stats) const = 0;
    [[nodiscard]] virtual std::size_t bytes() const = 0;
};

}  // namespace defocus::engine
