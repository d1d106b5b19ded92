#pragma once
// An aperture as a mask over the unit disk, and points of the lens by rejection: candidates all over the disk are taken
// as often as light passes there. Slow beside the inverse maps of lens/aperture.h, and none of their code.

#include <cstdint>
#include <glm/vec2.hpp>

#include "lens/lens.h"

namespace defocus::engine {

class ApertureMask {
public:
    // Throws Error where less than 1/500 of the disk's light would pass: too few candidates would be taken.
    explicit ApertureMask(const Lens& lens);

    // Straight blades and disks have a plain map of their own (lens_rays.h) and need no mask.
    [[nodiscard]] static bool isNeeded(const Lens& lens);

    // The light that passes at a point of the unit disk, of the most that passes anywhere, [0, 1]. Before the lens's
    // rotation and anamorphic ratio.
    [[nodiscard]] double at(const glm::dvec2& point) const;

    // Point `index` of stream `stream`, as scrambledPoint has them, rotated and narrowed as the lens is.
    [[nodiscard]] glm::dvec2 lensPoint(std::uint32_t index, std::uint32_t stream, std::uint32_t seed) const;

private:
    [[nodiscard]] double imageAt(const glm::dvec2& point) const;

    Lens lens_;
    double brightest_ = 1;
};

}  // namespace defocus::engine
