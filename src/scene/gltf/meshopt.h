#pragma once
// EXT_meshopt_compression: decompresses all compressed buffer views. Internal to the loader.

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// Fills Source::unpackedViews. Throws Error for invalid data.
void unpackMeshoptViews(Source& source);

}  // namespace defocus::engine::gltf
