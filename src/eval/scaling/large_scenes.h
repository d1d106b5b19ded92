#pragma once
// Measures two scenes that are larger than those of the scaling benchmark: 100 million triangles in 10,000 instances of
// one mesh, and 10,000 objects with separate meshes. Measures the time to the first image, the time of a frame, and the
// memory.

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
    bool instances = false;  // true: all objects share one mesh
};

// Returns the two scenes described at the top of this file.
std::vector<LargeScene> largeScenes();

struct LargeSceneRow {
    LargeScene scene;
    std::size_t meshes = 0;
    std::uint64_t triangles = 0;   // triangles of all objects at full detail
    double worldMilliseconds = 0;  // time to build the scene, and to build or load its pyramids
    Spread planMilliseconds;
    double firstImageMilliseconds = 0;  // time from plan to first image, including uploads and shader compilation
    double frameMilliseconds = 0;       // time of the second frame: all samples, but no uploads or compilation
    std::uint64_t trianglesDrawn = 0;   // triangles drawn in all samples together
    std::uint64_t residentBytes = 0;    // resident memory of the process after drawing
    std::uint64_t gpuBytes = 0;         // peak size of the renderer's resources
};

struct LargeSceneOptions {
    int runs = 3;                       // number of timed runs of the planning
    std::filesystem::path cacheFolder;  // cache of the pyramids; empty: no cache
    RendererOptions renderer;
};

// Measures a scene with 8 samples at 640 × 480 px, the lens of the built-in school of fish and the default levels.
// Needs a current GL context.
LargeSceneRow measureLargeScene(const LargeScene& scene, const LargeSceneOptions& options,
                                const Progress& progress = {});

// These functions return the header and a row of a text table.
std::string largeSceneHeader();
std::string largeSceneLine(const LargeSceneRow& row);

}  // namespace defocus::engine
