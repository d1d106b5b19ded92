#pragma once
// The renderer around the lens-space methods. They process a frame's triangles once and find, for each pixel, what many
// rays through the lens hit. The accumulation instead draws the triangles again for each lens sample.

#include <memory>

#include "render/lens_space/visibility_kernel.h"
#include "render/methods.h"

namespace defocus::engine {

// Setting "shading" of these methods, which decides VisibilityKernel::lightsVertices().
MethodSetting shadingSetting();

// Returns a renderer that uses `kernel`. `options.settings` must be complete. Starting a frame throws Error, naming the
// object or the setting, for unsupported features: blended and alpha-tested materials, blur controls that vary
// nonlinearly inside triangles, axial chromatic aberration, astigmatism and coma, cat's eye, exact motion.
std::unique_ptr<Renderer> makeLensSpaceRenderer(const World& world, const RendererOptions& options,
                                                std::unique_ptr<VisibilityKernel> kernel);

}  // namespace defocus::engine
