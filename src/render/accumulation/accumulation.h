#pragma once
// Method "accumulation": draws every object once per lens sample, in waves of K samples, into a layered target. The
// plan gives each object's levels and the samples that use them (Haeberli and Akeley 1990; Jeong, Kim and Lee 2011).

#include <memory>

#include "render/accumulation/shared_images.h"
#include "render/methods.h"

namespace defocus::engine {

// Returns a renderer of this method. It needs a current GL 4.5 context, which must outlive the renderer.
std::unique_ptr<Renderer> makeAccumulationRenderer(const World& world, const RendererOptions& options);
// Returns a renderer of this method whose samples share images within a block; see SharedImages.
std::unique_ptr<Renderer> makeSharingAccumulation(const World& world, const RendererOptions& options,
                                                  std::unique_ptr<SharedImages> shared);

}  // namespace defocus::engine
