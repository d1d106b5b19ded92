#pragma once
// Reads materials, textures and images. Internal to the glTF loader.

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

std::vector<Material> readMaterials(Source& source);

// Returns one Texture per glTF texture. A texture without a supported image has `image` −1; no material refers to it.
std::vector<Texture> readTextures(Source& source);

struct Images {
    std::vector<TextureImage> images;
    std::vector<std::string> names;
};

// Decodes all images in parallel. Throws Error, with the image's name in its message, if an image is damaged or
// missing.
Images readImages(Source& source, const Progress& progress);

}  // namespace defocus::engine::gltf
