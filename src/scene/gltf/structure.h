#pragma once
// A document's JSON → tinygltf's structures. Internal to the loader.

#include "scene/gltf/document.h"
#include "scene/gltf/tinygltf.h"

namespace defocus::engine::gltf {

// Everything but buffers, images, materials and scenes, which their readers take from the JSON. The document must have
// passed checkSchema. Throws Error for what tinygltf can't read.
tinygltf::Model readStructure(const Document& document);

}  // namespace defocus::engine::gltf
