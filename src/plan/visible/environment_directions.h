#pragma once
// Chooses directions to the environment, for shadows in environment lighting.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/scene.h"

namespace defocus::engine {

// Importance sampling of directions to the environment. Cells of an equirectangular grid are chosen in proportion to
// luminance × solid angle × importance. The importance is a weight that may favour light from above.
class EnvironmentDirections {
public:
    EnvironmentDirections() = default;
    // With `onGround`, shadows are assumed to fall mostly on horizontal ground. The importance of a direction is then
    // 0.25 + 0.75·max(0, cos θ), where θ is the angle to the zenith; otherwise it is 1. The constant term is for
    // surfaces of other orientations.
    explicit EnvironmentDirections(const Environment& environment, bool onGround = false);

    struct Choice {
        glm::dvec3 toLight{0, 1, 0};  // unit vector to the environment
        glm::dvec3 radiance{0.0};     // radiance divided by the probability density of the direction, W/m²
    };
    // Maps `point` ∈ [0, 1)² to a direction.
    [[nodiscard]] Choice at(const glm::dvec2& point) const;
    // Returns the illuminance from the environment, averaged over all orientations of a surface. Colours are converted
    // to luminance.
    [[nodiscard]] double meanIlluminance() const { return meanIlluminance_; }
    [[nodiscard]] bool empty() const { return rowSums_.empty() || !(rowSums_.back() > 0); }

private:
    bool onGround_ = false;
    std::vector<glm::dvec3> radiances_;
    double meanIlluminance_ = 0;
    // Cumulative sums of luminance × solid angle × importance: over all rows from the top down, and over the cells
    // inside each row.
    std::vector<double> rowSums_;
    std::vector<double> cellSums_;
};

}  // namespace defocus::engine
