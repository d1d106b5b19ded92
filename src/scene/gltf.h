#pragma once
// glTF 2.0 files (.gltf, .glb) → Scene. Every accessor, index and size is checked before it is used: a bad file gives an Error
// that names the file and the fault, never undefined behaviour. Unsupported *required* extensions are an Error naming them;
// whatever is not drawn is listed in Scene::ignored with its reason.

#include <filesystem>

#include "core/progress.h"
#include "scene/scene.h"

namespace defocus {

Scene loadGltf(const std::filesystem::path& path, const Progress& progress = {});

}  // namespace defocus
