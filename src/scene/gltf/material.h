#pragma once
// Materials, textures and images. Internal to the loader.

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

std::vector<Material> readMaterials(Source& source);

// Returns one Texture per glTF texture. A texture without a supported image has image -1, and no material uses it.
std::vector<Texture> readTextures(Source& source);

struct Images {
    std::vector<TextureImage> images;
    std::vector<std::string> names;
};

// Decodes all images in parallel. Throws Error that names a broken or missing image.
Images readImages(Source& source, const Progress& progress);

}  // namespace defocus::engine::gltf
