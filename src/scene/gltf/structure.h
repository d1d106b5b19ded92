#pragma once
// Converts a document's JSON to tinygltf structures. Internal to the glTF loader.

#include "scene/gltf/document.h"
#include "scene/gltf/tinygltf.h"

namespace defocus::engine::gltf {

// Converts all parts except buffers, images, materials and scenes, which are read directly from the JSON. The document
// must have passed checkSchema. Throws Error if tinygltf cannot parse a part.
tinygltf::Model readStructure(const Document& document);

}  // namespace defocus::engine::gltf
