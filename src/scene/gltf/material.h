#pragma once
// Materials, textures and their images. Internal to the loader.

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

std::vector<Material> readMaterials(Source& source);

// Textures of the file, one a glTF texture; a texture without a plain image has image -1 and no material uses it.
std::vector<Texture> readTextures(Source& source);

struct Images {
    std::vector<TextureImage> images;
    std::vector<std::string> names;
};

// Decodes every image, on all cores. A broken or missing one is an Error naming it.
Images readImages(Source& source, const Progress& progress);

}  // namespace defocus::engine::gltf
