#pragma once
// How one sample's radiance is kept until it is summed.

#include "gl/program.h"
#include "gl/texture.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

// `asked`, or for automatic what the world's radiance needs. Throws Error for a format that can't hold what the plan
// draws.
LayerFormat chosenLayerFormat(const World& world, const FramePlan& plan, LayerFormat asked);

// The defines that make shaders write or read `format` (not automatic).
ShaderDefines layerFormatDefines(LayerFormat format);
const char* layerFormatName(LayerFormat format);
TextureFormat layerTextureFormat(LayerFormat format);
// Bytes a pixel of one layer, depth included.
std::size_t layerPixelBytes(LayerFormat format);

}  // namespace defocus::engine
