#pragma once
// Method "accumulation": every object is drawn once per lens sample, in waves of K samples into a layered target, at
// the level and for the samples that the plan gives it (Haeberli and Akeley 1990; Jeong, Kim and Lee 2011).

#include <memory>

#include "render/accumulation/shared_images.h"
#include "render/methods.h"

namespace defocus::engine {

// Needs a current GL 4.5 context, which must outlive the renderer.
std::unique_ptr<Renderer> makeAccumulationRenderer(const World& world, const RendererOptions& options);
// The same, with images that samples of a block share.
std::unique_ptr<Renderer> makeSharingAccumulation(const World& world, const RendererOptions& options,
                                                  std::unique_ptr<SharedImages> shared);

}  // namespace defocus::engine
