#pragma once
// Method "multirate": as the accumulation, but what is hardly blurred is drawn once for a group of neighbouring lens
// samples (plan/rates.h). Each sample's layer starts from a copy of what its group shares, colour and depth, and the
// rest is drawn in front of it and behind it. Layers are summed as the accumulation sums them.

#include <memory>

#include "render/methods.h"

namespace defocus {

// Needs a current GL 4.5 context, which must outlive the renderer.
std::unique_ptr<Renderer> makeMultirateRenderer(const World& world, const RendererOptions& options);

}  // namespace defocus
