#pragma once
// Method "multirate": as the accumulation, but each sample's image is blurred as the part of the lens that it stands
// for would blur it (plan/lens_cells.h), so that fewer samples do. Where a frame doesn't allow that, what is hardly
// blurred is drawn once for a group of neighbouring lens samples (plan/rates.h): each sample's layer starts from a copy
// of what its group shares, colour and depth, and the rest is drawn in front of it and behind it.

#include "render/methods.h"

namespace defocus::engine {

// Its row in the method table. Its renderers need a current GL 4.5 context, which must outlive them.
Method multirateMethod();

}  // namespace defocus::engine
