#pragma once
// Reads materials. Internal to the glTF loader.

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

std::vector<Material> readMaterials(Source& source);

}  // namespace defocus::engine::gltf
