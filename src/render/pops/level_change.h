#pragma once
// Finds image changes that are caused only by a change of levels of detail: makes two plans of one view and pose that
// differ only in levels, and finds the pixels that show the difference.

#include <optional>
#include <vector>

#include "image/image.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

struct HeldPlan {
    FramePlan plan;
    std::vector<const ObjectPlan*> changed;  // objects whose levels or samples per level differ from the previous plan
};

// Returns the plan of `object`, an index into Pose::objects; null if the plan doesn't draw the object.
const ObjectPlan* objectOf(const FramePlan& plan, int object);

// Returns `plan`, but objects that are also in the previous frame's plan `before` have the levels, and the division of
// samples between levels, from `before`. Returns nullopt if this changes nothing, or if the plans differ in their
// number of samples.
std::optional<HeldPlan> asBefore(const FramePlan& plan, const FramePlan& before);

// Marks in FramePlan::levelsUsed the levels of detail that the plan's objects draw.
void markUsed(FramePlan& plan);

// Returns a mask of one channel: 1 where a pixel shows an object or lies in the blur disk of such a pixel, else 0.
// `level` (−1 without object) and `coc` (diameter, px) come from AovImages.
Image objectPixels(const Image& level, const Image& coc);

// Returns the part of the mask `objects` that lies in the bounding boxes of the objects in `changed`. Each box is
// enlarged by its object's blur.
Image pixelsOf(const std::vector<const ObjectPlan*>& changed, const FramePlan& plan, const Image& objects);

// Returns the colours of a linear image as display values (sRGB, [0, 1], EV 0) in 3 channels.
Image displayColours(const Image& linear);

// Returns the root mean square of `difference` (3 channels of display values) over the pixels of the mask; over all
// pixels if `mask` is null.
double rootMeanSquare(const Image& difference, const Image* mask);

}  // namespace defocus::engine
