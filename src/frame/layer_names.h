#pragma once
// Lists the names of the data layers (defocus/layers.h) in the option --exr-layers and in EXR files.

#include <array>
#include <span>

#include "defocus/layers.h"

namespace defocus::engine {

struct LayerNames {
    Layer layer;
    const char* option;   // name in --exr-layers
    const char* nuke;     // layer name in Nuke's files
    const char* blender;  // pass name in Blender's files
    std::array<const char*, 3> channels;
};

// Returns the names of all layers, in the order of the enumeration.
std::span<const LayerNames> allLayerNames();
const LayerNames& layerNames(Layer layer);

}  // namespace defocus::engine
