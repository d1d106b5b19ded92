#pragma once
// Method "accumulation": draws every object once per lens sample, in batches (waves) of K samples, into a target with K
// layers. The plan selects each object's level of detail for each sample (Haeberli and Akeley 1990; Jeong, Kim and Lee
// 2011). Method "multirate" also blurs each sample's image, so that fewer samples suffice. This blur is that of the
// sample's cell, the part of the lens area that the sample stands for (plan/lens_cells/lens_cells.h). Method "auto"
// uses this blur for frames in which it is visible (plan/lens_cells/automatic_cells.h).

#include <memory>

#include "render/methods.h"

namespace defocus::engine {

// Each function returns a renderer of the method in the function's name. Each needs a current OpenGL 4.5 context, which
// must outlive the renderer.
std::unique_ptr<Renderer> makeAutomaticRenderer(const World& world, const RendererOptions& options);
std::unique_ptr<Renderer> makeAccumulationRenderer(const World& world, const RendererOptions& options);
std::unique_ptr<Renderer> makeMultirateRenderer(const World& world, const RendererOptions& options);

}  // namespace defocus::engine
