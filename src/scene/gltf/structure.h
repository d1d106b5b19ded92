#pragma once
// Converts a document's JSON to tinygltf structures. Internal to the glTF loader.

#include "scene/gltf/document.h"
#include "scene/gltf/tinygltf.h"

namespace defocus::engine::gltf {

// Converts the document's JSON, except buffers, images, materials and scenes, which are read directly from the JSON.
// The document must have passed checkSchema. Erases the JSON of accessors, which is large and no longer needed. Throws
// Error if tinygltf cannot parse an entry.
tinygltf::Model readStructure(Document& document);

}  // namespace defocus::engine::gltf
