#pragma once
// Scenes of glTF files, opened once and rendered often.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "defocus/export.h"
#include "defocus/progress.h"

namespace defocus {

namespace engine {
struct Scene;
}

// What a scene holds, by the names that a Request takes.
struct SceneInfo {
    std::string name;
    std::vector<std::string> cameras;  // empty strings for cameras without a name
    std::vector<std::string> nodes;
    std::vector<std::string> clips;    // animations
    std::uint64_t triangles = 0;       // of all meshes, each counted once
    std::vector<std::string> ignored;  // parts of the file that are not drawn, and why: a line each
};

// A scene that never changes. Copies share it, and any number of renderers and threads may use it.
class DEFOCUS_API Scene {
public:
    // Reads a glTF 2.0 file (.gltf or .glb). Throws Error naming the file and the fault.
    static Scene load(const std::filesystem::path& path, const Progress& progress = {});
    // The built-in school: `fishCount` fish (1 … 10,000) of about `trianglesPerFish` triangles (200 … 10,000,000).
    static Scene schoolOfFish(int fishCount = 20, int trianglesPerFish = 90'000, const Progress& progress = {});

    [[nodiscard]] SceneInfo info() const;

    // For the library: the scene behind the interface.
    explicit Scene(std::shared_ptr<const engine::Scene> scene) : scene_(std::move(scene)) {}
    [[nodiscard]] const std::shared_ptr<const engine::Scene>& engineScene() const { return scene_; }

private:
    std::shared_ptr<const engine::Scene> scene_;
};

}  // namespace defocus
