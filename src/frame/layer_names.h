#pragma once
// Names of data layers (defocus/layers.h): in --exr-layers, and in EXR files.

#include <array>
#include <span>

#include "defocus/layers.h"

namespace defocus::engine {

struct LayerNames {
    Layer layer;
    const char* option;   // in --exr-layers
    const char* nuke;     // layer in Nuke's files
    const char* blender;  // pass in Blender's files
    std::array<const char*, 3> channels;
};

// Returns the names of all layers, in the order of the enumeration.
std::span<const LayerNames> allLayerNames();
const LayerNames& layerNames(Layer layer);

}  // namespace defocus::engine
