#pragma once
// Validates a document's JSON against the supported part of the glTF 2.0 schema: property types, array lengths and
// references by index. The readers rely on these checks. Internal to the glTF loader.

#include "scene/gltf/document.h"

namespace defocus::engine::gltf {

// Throws Error for an invalid property, e.g. "accessors[3].bufferView is 7, but the file has 2 bufferViews". Converts
// integers written as floats (100.0) to integers in the document.
void checkSchema(Document& document);

}  // namespace defocus::engine::gltf
