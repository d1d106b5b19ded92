#pragma once
// Reads textures and images. Internal to the glTF loader.

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

struct Textures {
    std::vector<Texture> textures;     // one per glTF texture; `image` is −1 if no material uses the texture
    std::vector<TextureImage> images;  // images that materials use
    std::vector<std::string> names;    // one name per entry of `images`
};

// Reads the textures. Decodes, in parallel, the images that `materials` use. A texture whose image is missing or
// damaged is removed from the materials and listed in Source::ignored.
Textures readTextures(Source& source, std::vector<Material>& materials, const Progress& progress);

}  // namespace defocus::engine::gltf
