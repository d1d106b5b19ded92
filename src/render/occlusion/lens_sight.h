#pragma once
// Where one lens sample sees a box of an object's space: the pixels that it may touch, and its nearest depth. Nothing
// in the box is drawn elsewhere or nearer, as far as rasterisers round.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "plan/frame_plan.h"

namespace defocus::engine {

struct SeenBox {
    // Pixels of the layer, from its lower left corner, the ends not included; none where left ≥ right or bottom ≥ top.
    int left = 0, right = 0;
    int bottom = 0, top = 0;
    float depth = 0;  // no less than any that is drawn; reversed
};

// Whether LensSight holds for all samples of the plan: C = a + b·w alike for all, and nothing moves.
bool seesBoxes(const FramePlan& plan);
// Whether it holds for the object, which must stand still as its level has it.
bool seesBoxes(const ObjectPlan& object);

class LensSight {
public:
    LensSight(const FramePlan& plan, const ObjectPlan& object, std::uint32_t sample);

    // `centre` and `reach` (half of the sides) in object units. None where the box may come too near to the camera.
    [[nodiscard]] std::optional<SeenBox> of(const glm::vec3& centre, const glm::vec3& reach) const;

private:
    // (x, y, w) of a place p is linear_·p + offset_, and its pixel is scale_·(x, y)/w + middle_.
    glm::dmat3 linear_{1};
    glm::dvec3 offset_{0};
    glm::dmat3 sizes_{1};  // absolute values of linear_
    glm::dvec2 scale_{1};
    glm::dvec2 middle_{0};
    double lost_ = 0;  // m that single precision may lose of a position
    double nearPlane_ = 0;
    glm::ivec2 layer_{0};  // px
};

}  // namespace defocus::engine
