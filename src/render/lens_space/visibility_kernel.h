#pragma once
// What tells the lens-space methods apart: their rays, and how they find what these meet.

#include "render/lens_space/lens_front.h"
#include "render/lens_space/ray_sets.h"
#include "render/renderer.h"

namespace defocus::engine {

inline constexpr std::size_t recordBytes = 4 * sizeof(std::uint32_t);  // of shaders/lens_space/records.glsl

// Rays [first, first + count) of each pixel.
struct RayWave {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

class VisibilityKernel {
public:
    virtual ~VisibilityKernel() = default;
    [[nodiscard]] virtual std::string name() const = 0;        // of the method
    [[nodiscard]] virtual std::uint32_t tileSize() const = 0;  // px
    // Whether surfaces are shaded at their vertices, and interpolated, instead of where they are seen.
    [[nodiscard]] virtual bool lightsVertices() const = 0;
    // Throws Error for a plan that the method can't draw.
    [[nodiscard]] virtual RaySets raySets(const FramePlan& plan, std::uint32_t partsOfExposure) const = 0;
    // What shaders that read rays and records need, beside VARIANTS.
    [[nodiscard]] virtual ShaderDefines rayDefines() const = 0;
    // Bytes of a ray's records, at least.
    [[nodiscard]] virtual std::uint64_t rayBytes() const = 0;
    // Before the first wave of a frame. `defines` are those of the front and of the rays.
    virtual void start(const FramePlan& plan, const RaySets& rays, const ShaderDefines& defines) = 0;
    // Finds what a wave's rays meet and returns the number of records. Takes rays off the end of a wave that meets more
    // than a buffer holds. The frame's uniforms and the rays are bound.
    virtual std::uint64_t find(LensFront& front, RayWave& wave) = 0;
    // Binds what shaders/lens_space/ knows as records, and for lines their ranges.
    virtual void bindRecords() const = 0;
    virtual void addTo(RenderStats& stats) const = 0;
    [[nodiscard]] virtual std::size_t bytes() const = 0;
};

}  // namespace defocus::engine
