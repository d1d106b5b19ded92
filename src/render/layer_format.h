#pragma once
// Storage format of the radiance of single samples, before they are summed.

#include "gl/program.h"
#include "gl/texture.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

// Returns `asked`, or for automatic the format that the world's radiance needs.
LayerFormat chosenLayerFormat(const World& world, LayerFormat asked);

// Returns the defines with which shaders write or read `format`. Automatic is not allowed.
ShaderDefines layerFormatDefines(LayerFormat format);
const char* layerFormatName(LayerFormat format);
TextureFormat layerTextureFormat(LayerFormat format);
// Returns the bytes per pixel of one layer, depth included.
std::size_t layerPixelBytes(LayerFormat format);

}  // namespace defocus::engine
