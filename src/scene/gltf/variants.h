#pragma once
// Reads and applies a file's material variants (KHR_materials_variants). Internal to the glTF loader.

#include <string>
#include <vector>

#include "scene/gltf/document.h"

namespace defocus::engine::gltf {

// Returns the names of the file's variants, in the file's order.
std::vector<std::string> variantNames(const Document& document);

// Gives primitives the materials of the variant `name`. If several variants have this name, uses the first. Throws
// Error, with the names of all variants, if the file has no such variant.
void chooseVariant(Document& document, const std::string& name);

}  // namespace defocus::engine::gltf
