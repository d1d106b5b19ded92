#pragma once
// Scenes that are opened or created once and rendered many times.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "defocus/export.h"
#include "defocus/progress.h"
#include "defocus/scene_data.h"

namespace defocus {

namespace engine {
struct Scene;
}

// Contents of a scene, with the names that a Request accepts.
struct SceneInfo {
    std::string name;
    std::vector<std::string> cameras;  // names of cameras; an empty string for an unnamed camera
    std::vector<std::string> nodes;
    std::vector<std::string> clips;     // names of animations
    std::vector<std::string> variants;  // names of the material variants
    std::uint64_t triangles = 0;        // sum over all meshes, independent of the number of instances
    std::vector<std::string> ignored;   // parts of the file that are not drawn, and the reason; one line each
};

// Immutable scene. Copies share their data. Any number of renderers and threads may use a scene concurrently.
class DEFOCUS_API Scene {
public:
    // Reads a glTF 2.0 file (.gltf or .glb). Throws Error, with the path in its message, if the file is invalid.
    // `variant`: name of a material variant of the file (KHR_materials_variants); empty: the default materials.
    static Scene load(const std::filesystem::path& path, const Progress& progress = {},
                      const std::string& variant = {});
    // Returns the built-in school of `fishCount` fish (1 … 10,000) with approximately `trianglesPerFish` triangles each
    // (200 … 10,000,000).
    static Scene schoolOfFish(int fishCount = 20, int trianglesPerFish = 90'000, const Progress& progress = {});

    // Creates a scene from data in memory, which is copied. Throws UsageError, with the faulty part in its message, for
    // sizes that don't match, indices or values out of range, NaN, infinity, or a scene without instances.
    static Scene create(const SceneData& data);

    [[nodiscard]] SceneInfo info() const;

    // Internal: for the library only.
    explicit Scene(std::shared_ptr<const engine::Scene> scene) : scene_(std::move(scene)) {}
    [[nodiscard]] const std::shared_ptr<const engine::Scene>& engineScene() const { return scene_; }

private:
    std::shared_ptr<const engine::Scene> scene_;
};

}  // namespace defocus
