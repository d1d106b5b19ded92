#pragma once
// Checks a document's JSON against the part of the glTF 2.0 schema that is read here: the type of every property, the
// length of arrays, and that every reference leads to something that exists. What comes after can rely on it. Internal
// to the loader.

#include "scene/gltf/document.h"

namespace defocus::engine::gltf {

// Throws Error naming the place, e.g. "accessors[3].bufferView is 7, but the file has 2 bufferViews". JSON has one type
// of numbers: an integer that is written as a float (100.0) becomes one.
void checkSchema(Document& document);

}  // namespace defocus::engine::gltf
