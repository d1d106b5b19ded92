#pragma once
// Method "accumulation": draws every object once per lens sample, in waves of K samples, into a layered target. The
// plan gives each object's levels and the samples that use them (Haeberli and Akeley 1990; Jeong, Kim and Lee 2011).
// Method "multirate" also blurs each sample's image by the part of the lens that the sample stands for
// (plan/lens_cells/lens_cells.h). Fewer samples then suffice.

#include <memory>

#include "render/methods.h"

namespace defocus::engine {

// Return a renderer of the method. It needs a current GL 4.5 context, which must outlive the renderer.
std::unique_ptr<Renderer> makeAccumulationRenderer(const World& world, const RendererOptions& options);
std::unique_ptr<Renderer> makeMultirateRenderer(const World& world, const RendererOptions& options);

}  // namespace defocus::engine
