#pragma once
// An aperture as a mask over the unit disk, sampled by rejection: candidates are accepted with the probability that
// light passes. Slower than the inverse maps of lens/aperture.h, but independent of their code.

#include <cstdint>
#include <glm/vec2.hpp>

#include "lens/lens.h"

namespace defocus::engine {

class ApertureMask {
public:
    // Throws Error if less than 1/500 of the disk's light passes, because too few candidates would be accepted.
    explicit ApertureMask(const Lens& lens);

    // Returns whether the lens needs a mask. Disks and straight blades don't: aperturePoint (lens_rays.h) maps to them
    // directly.
    [[nodiscard]] static bool isNeeded(const Lens& lens);

    // Returns the light that passes at a point of the unit disk relative to the brightest point, in [0, 1]. The point
    // is not yet rotated or scaled by the anamorphic ratio.
    [[nodiscard]] double at(const glm::dvec2& point) const;

    // Returns the lens point `index` of stream `stream` (see scrambledPoint), rotated and scaled like the aperture.
    [[nodiscard]] glm::dvec2 lensPoint(std::uint32_t index, std::uint32_t stream, std::uint32_t seed) const;

private:
    [[nodiscard]] double imageAt(const glm::dvec2& point) const;

    Lens lens_;
    double brightest_ = 1;
};

}  // namespace defocus::engine
