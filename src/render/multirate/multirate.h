#pragma once
// Method "multirate": like the accumulation, but blurs each sample's image by the part of the lens that the sample
// represents (plan/lens_cells.h). Fewer samples then suffice. If a frame doesn't allow this, objects with little blur
// are drawn once per group of neighbouring lens samples (plan/rates.h). Each sample's layer starts from a copy of its
// group's colour and depth. The other objects are drawn over it with the depth test.

#include "render/methods.h"

namespace defocus::engine {

// Returns this method's entry for the method table. Its renderers need a current GL 4.5 context, which must outlive
// them.
Method multirateMethod();

}  // namespace defocus::engine
