#pragma once
// Loads glTF 2.0 files (.gltf, .glb) as a Scene. Every accessor, index and size is checked before use. Throws Error,
// with the file's path, for an invalid file or an unsupported required extension. Other content that is not drawn, such
// as textures whose image is missing or damaged, is listed in Scene::ignored with the reason.
//
// Missing data is completed as glTF requires. Primitives without normals are flat-shaded with unshared vertices;
// missing tangents are generated for normal maps. Unused vertices are dropped, so a mesh may have fewer vertices than
// its accessors. The nodes of the default scene are loaded. Without a default scene, the nodes of the first scene are
// loaded. Without scenes, all nodes are loaded.

#include <filesystem>
#include <string>

#include "core/progress.h"
#include "scene/scene.h"

namespace defocus::engine {

// Loads a file. Primitives get the materials of `variant` (KHR_materials_variants), or their default materials if
// `variant` is empty. Throws Error, with the names of all variants, if the file has no such variant.
Scene loadGltf(const std::filesystem::path& path, const Progress& progress = {}, const std::string& variant = {});

}  // namespace defocus::engine
