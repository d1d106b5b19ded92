#pragma once
// Scenes of glTF files, opened once and rendered often.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "defocus/export.h"
#include "defocus/progress.h"

namespace defocus {

struct Scene;  // the library's own

// Shared: whoever renders a scene keeps it alive.
using SceneHandle = std::shared_ptr<const Scene>;

// Reads a glTF 2.0 file (.gltf or .glb). Throws Error naming the file and the fault.
DEFOCUS_API SceneHandle loadScene(const std::filesystem::path& path, const Progress& progress = {});

// The built-in school of fish: `fishCount` fish (1 … 10,000) of about `trianglesPerFish` triangles.
DEFOCUS_API SceneHandle schoolOfFish(int fishCount = 20, int trianglesPerFish = 90'000, const Progress& progress = {});

// What a scene holds, by the names that a Request takes.
struct SceneInfo {
    std::string name;
    std::vector<std::string> cameras;  // nameless ones are empty
    std::vector<std::string> nodes;
    std::vector<std::string> clips;    // animations
    std::uint64_t triangles = 0;       // of all meshes, each counted once
    std::vector<std::string> ignored;  // what of the file is not drawn, and why: a line each
};

DEFOCUS_API SceneInfo sceneInfo(const Scene& scene);

}  // namespace defocus
