#pragma once
// Method "layered": Lee, Eisemann and Seidel 2010, Real-Time Lens Blur Effects and Focus Control. The scene is drawn
// through the middle of the lens as depth layers, which hold what lies behind the nearest surface too; then the lens
// rays of each pixel look for what they meet in the layers (lens_rays.h). The scene is drawn as often as there are
// layers, however many lens samples there are.
//
// As published, layers are point-sampled, which leaves jagged edges in focus. Several pinholes spread over the pixel
// smooth them, each with its own layers and its share of the lens samples (setting "pinholes").
//
// What differs from a lens: no ray sees what is hidden in all layers or shows its back to the middle of the lens, and
// reflections are those of the middle of the lens.

#include "render/methods.h"

namespace defocus::engine {

Method layeredMethod();

}  // namespace defocus::engine
