#pragma once
// glTF 2.0 files (.gltf, .glb) → Scene. Every accessor, index and size is checked before it is used: a bad file gives
// an Error that names the file and the fault, never undefined behaviour. Unsupported *required* extensions are an Error
// naming them; whatever is not drawn is listed in Scene::ignored with its reason.
//
// What a file leaves out is filled in as the standard says: a primitive without normals is shaded flat on vertices of
// its own, one whose normal map lacks tangents gets them. Vertices that no triangle uses are dropped, so a mesh may
// have fewer than its accessors. The nodes are those of the file's default scene (else of its first, else all).

#include <filesystem>

#include "core/progress.h"
#include "scene/scene.h"

namespace defocus::engine {

Scene loadGltf(const std::filesystem::path& path, const Progress& progress = {});

}  // namespace defocus::engine
