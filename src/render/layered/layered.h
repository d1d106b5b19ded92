#pragma once
// Method "layered": Lee, Eisemann and Seidel 2010, Real-Time Lens Blur Effects and Focus Control. The scene is drawn
// through the lens centre as depth layers, which also hold surfaces behind the nearest one. The lens rays of each pixel
// are then intersected with the layers (lens_rays.h). The number of scene passes is the number of layers, for any
// number of lens samples.
//
// As published, layers are point-sampled, which leaves jagged edges in focus. Several pinholes spread over the pixel
// smooth these edges. Each pinhole has its own layers and its share of the lens samples (setting "pinholes").
//
// Differences from a real lens: rays miss surfaces that are hidden in all layers or face away from the lens centre.
// Reflections are those seen from the lens centre.

#include "render/methods.h"

namespace defocus::engine {

Method layeredMethod();

}  // namespace defocus::engine
