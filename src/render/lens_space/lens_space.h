#pragma once
// The frame around the lens-space methods: they draw a frame's triangles once, and find for each pixel what many rays
// through the lens meet, where the accumulation draws the triangles again for each lens sample.

#include <memory>

#include "render/lens_space/visibility_kernel.h"
#include "render/methods.h"

namespace defocus::engine {

// The setting of these methods that VisibilityKernel::lightsVertices() follows.
MethodSetting shadingSetting();

// `options.settings` must be complete. Starting a frame throws Error, naming the object or the setting, for what these
// methods can't draw: blended and alpha-tested materials, controls of the blur that bend inside triangles, axial
// chromatic aberration, the cat's eye, exact motion.
std::unique_ptr<Renderer> makeLensSpaceRenderer(const World& world, const RendererOptions& options,
                                                std::unique_ptr<VisibilityKernel> kernel);

}  // namespace defocus::engine
