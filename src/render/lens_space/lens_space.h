#pragma once
// Renderer of the lens-space methods. These methods process a frame's triangles once and find the hits of many lens
// rays for each pixel, whereas method "accumulation" draws the triangles again for each lens sample.

#include <memory>

#include "render/lens_space/visibility_kernel.h"
#include "render/methods.h"

namespace defocus::engine {

// Returns the setting "shading" of the lens-space methods, which determines VisibilityKernel::lightsVertices().
MethodSetting shadingSetting();
// Returns the setting "coc-interpolation" of the lens-space methods, which determines LensFrontOptions::divides.
MethodSetting cocInterpolationSetting();

// Returns a renderer that finds hits with `kernel`. `options.settings` must be complete. Renderer::start throws Error,
// with the setting in its message, for unsupported features: axial chromatic aberration, cat's eye, exact motion, and
// features that the kernel does not support.
std::unique_ptr<Renderer> makeLensSpaceRenderer(const World& world, const RendererOptions& options,
                                                std::unique_ptr<VisibilityKernel> kernel);

}  // namespace defocus::engine
