#pragma once
// Validates a document's JSON against the supported part of the glTF 2.0 schema. It checks property types, array
// lengths, and that references lead to existing entries. Later code relies on these checks. Internal to the loader.

#include "scene/gltf/document.h"

namespace defocus::engine::gltf {

// Throws Error that names the property, e.g. "accessors[3].bufferView is 7, but the file has 2 bufferViews". Integers
// written as floats (100.0) are converted to integers in the document.
void checkSchema(Document& document);

}  // namespace defocus::engine::gltf
