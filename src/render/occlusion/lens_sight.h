#pragma once
// Projects a bounding box in object space as one lens sample sees it: the pixels it may touch, and its nearest depth.
// The bounds are conservative, including the rounding of rasterizers.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "plan/frame_plan.h"

namespace defocus::engine {

struct SeenBox {
    // Pixels of the layer, from its lower left corner; right and top are exclusive. Empty if left ≥ right or bottom ≥
    // top.
    int left = 0, right = 0;
    int bottom = 0, top = 0;
    float depth = 0;  // upper bound of the box's depth, reversed
};

// Returns whether LensSight works for the plan: C = a + b·w is the same for all samples, and nothing moves.
bool seesBoxes(const FramePlan& plan);
// Returns whether LensSight works for the object, which must be static and undeformed.
bool seesBoxes(const ObjectPlan& object);

class LensSight {
public:
    LensSight(const FramePlan& plan, const ObjectPlan& object, std::uint32_t sample);

    // Returns the projection of a box with this `centre` and `reach` (half the side lengths), in object units. Empty if
    // the box may be too close to the camera.
    [[nodiscard]] std::optional<SeenBox> of(const glm::vec3& centre, const glm::vec3& reach) const;

private:
    // For a position p, (x, y, w) = linear_·p + offset_, and its pixel is scale_·(x, y)/w + middle_.
    glm::dmat3 linear_{1};
    glm::dvec3 offset_{0};
    glm::dmat3 sizes_{1};  // absolute values of linear_
    glm::dvec2 scale_{1};
    glm::dvec2 middle_{0};
    double lost_ = 0;  // m, max error of a position in single precision
    double nearPlane_ = 0;
    glm::ivec2 layer_{0};  // size of the layer, px
};

}  // namespace defocus::engine
