#pragma once
// Projects an object-space bounding box for one lens sample: computes bounds of the pixels that the box may cover, and
// of the box's depth. The bounds are conservative and include the rounding of rasterizers.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "plan/frame_plan.h"

namespace defocus::engine {

struct SeenBox {
    // Pixels [left, right) × [bottom, top) of the layer, from its lower left corner; empty if left ≥ right or bottom ≥
    // top.
    int left = 0, right = 0;
    int bottom = 0, top = 0;
    float depth = 0;  // upper bound of the box's depth values; depth is reversed, so no point is nearer
};

// Returns whether LensSight supports the plan: the circle of confusion must be the same linear function of depth for
// all samples, and nothing may move.
bool seesBoxes(const FramePlan& plan);
// Returns whether LensSight supports the object: it must neither move nor be deformed, and must have no blur modifiers.
bool seesBoxes(const ObjectPlan& object);

class LensSight {
public:
    LensSight(const FramePlan& plan, const ObjectPlan& object, std::uint32_t sample);

    // Returns the projection of a box with this `centre` and `reach` (half the side lengths), in object units; nullopt
    // if the box may extend in front of the near plane.
    [[nodiscard]] std::optional<SeenBox> of(const glm::vec3& centre, const glm::vec3& reach) const;

private:
    // A position p has the clip coordinates (x, y, w) = linear_·p + offset_ and the pixel coordinates scale_·(x, y)/w +
    // middle_.
    glm::dmat3 linear_{1};
    glm::dvec3 offset_{0};
    glm::dmat3 sizes_{1};  // absolute values of linear_
    glm::dvec2 scale_{1};
    glm::dvec2 middle_{0};
    double lost_ = 0;  // max error in m of a transformed position in single precision
    double nearPlane_ = 0;
    glm::ivec2 layer_{0};  // size of the layer in px
};

}  // namespace defocus::engine
