#pragma once
// How one sample's radiance is kept until it is summed.

#include "gl/program.h"
#include "gl/texture.h"
#include "plan/frame_plan.h"

namespace defocus {

enum class LayerFormat {
    automatic,  // rgba16f, or rgba32f where the scene's radiance may exceed 6e4
    rgba16f,    // half floats: 2⁻¹¹ relative error a sample
    rgba32f,    // references
    rgb9e5,     // 32 bits with a shared exponent, dithered over the samples: half the memory; opaque scenes only
    rgba8,      // clips at 1: a bound for the table of formats, not for pictures
};

// `asked`, or for automatic what the world's radiance needs. Throws Error for a format that can't hold what the plan
// draws.
LayerFormat chosenLayerFormat(const World& world, const FramePlan& plan, LayerFormat asked);

// The defines that make shaders write or read `format` (not automatic).
ShaderDefines layerFormatDefines(LayerFormat format);
const char* layerFormatName(LayerFormat format);
TextureFormat layerTextureFormat(LayerFormat format);
// Bytes a pixel of one layer, depth included.
std::size_t layerPixelBytes(LayerFormat format);

}  // namespace defocus
