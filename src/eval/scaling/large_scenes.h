#pragma once
// Two scenes beyond what the axes of the scaling benchmark reach: 100 million triangles in 10,000 instances of one
// mesh, and 10,000 objects of which each has a mesh of its own. What counts there isn't the time of a frame alone, but
// how long it takes until there is one, and what it takes of memory.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "eval/spread.h"
#include "render/methods.h"

namespace defocus::engine {

struct LargeScene {
    std::string name;
    int objects = 0;
    int trianglesPerObject = 0;
    bool instances = false;  // of one mesh
};

// The two.
std::vector<LargeScene> largeScenes();

struct LargeSceneRow {
    LargeScene scene;
    std::size_t meshes = 0;
    std::uint64_t triangles = 0;   // of all objects at full detail
    double worldMilliseconds = 0;  // the scene, and its pyramids, which may come from the disk
    Spread planMilliseconds;
    double firstImageMilliseconds = 0;  // from the plan to the image of the first wave, with uploads and shaders
    double frameMilliseconds = 0;       // the same frame once more, all samples
    std::uint64_t trianglesDrawn = 0;   // over all samples
    std::uint64_t residentBytes = 0;    // of the process, with the image drawn
    std::uint64_t gpuBytes = 0;         // the most that the renderer's resources took
};

struct LargeSceneOptions {
    int runs = 3;                       // of the plan
    std::filesystem::path cacheFolder;  // for pyramids; empty for none
    RendererOptions renderer;
};

// 8 samples, 640 × 480 px, the school's own lens, levels as `render` has them. Needs a current GL context.
LargeSceneRow measureLargeScene(const LargeScene& scene, const LargeSceneOptions& options,
                                const Progress& progress = {});

// A table for people, and a JSON list.
std::string largeSceneHeader();
std::string largeSceneLine(const LargeSceneRow& row);

}  // namespace defocus::engine
