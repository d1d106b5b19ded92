#pragma once
// Storage format of the layers, which hold the radiance of single samples before they are summed.

#include "gl/program.h"
#include "gl/texture.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

// Returns `asked`, or, if `asked` is LayerFormat::automatic, the format that the world's radiance needs.
LayerFormat chosenLayerFormat(const World& world, LayerFormat asked);

// Returns the defines for shaders that write or read `format`, which must not be LayerFormat::automatic.
ShaderDefines layerFormatDefines(LayerFormat format);
const char* layerFormatName(LayerFormat format);
TextureFormat layerTextureFormat(LayerFormat format);
// Returns the bytes per pixel of one layer, including depth.
std::size_t layerPixelBytes(LayerFormat format);

}  // namespace defocus::engine
