#pragma once
// EXT_meshopt_compression: unpacks every compressed buffer view. Internal to the loader.

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// Fills Source::unpackedViews. Throws Error for data that does not decode.
void unpackMeshoptViews(Source& source);

}  // namespace defocus::engine::gltf
