#pragma once
// Decompresses buffer views with EXT_meshopt_compression. Internal to the glTF loader.

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// Fills Source::unpackedViews with the decompressed bytes of all compressed buffer views. Throws Error for invalid
// data.
void unpackMeshoptViews(Source& source);

}  // namespace defocus::engine::gltf
