#pragma once
// Represents an aperture as a mask over the unit disk and samples it by rejection: a candidate point is accepted with a
// probability proportional to the mask's transmission there. Slower than the inverse maps of lens/aperture.h, but
// independent of their code.

#include <cstdint>
#include <glm/vec2.hpp>

#include "lens/lens.h"

namespace defocus::engine {

class ApertureMask {
public:
    // Throws Error if the mask transmits less than 1/500 of the light on the disk, because sampling would reject too
    // many candidates.
    explicit ApertureMask(const Lens& lens);

    // Returns whether the lens needs a mask. Disks and polygons with straight blades need none, because aperturePoint
    // (lens_rays.h) samples them directly.
    [[nodiscard]] static bool isNeeded(const Lens& lens);

    // Returns the transmission at `point` of the unit disk, relative to the disk's most transparent point, in [0, 1].
    // `point` is the position before the rotation and the anamorphic scaling of the aperture.
    [[nodiscard]] double at(const glm::dvec2& point) const;

    // Returns lens point number `index`, after rotation and anamorphic scaling. `stream` selects the scramble, as in
    // scrambledPoint (lens_rays.h).
    [[nodiscard]] glm::dvec2 lensPoint(std::uint32_t index, std::uint32_t stream, std::uint32_t seed) const;

private:
    [[nodiscard]] double imageAt(const glm::dvec2& point) const;

    Lens lens_;
    double brightest_ = 1;
};

}  // namespace defocus::engine
