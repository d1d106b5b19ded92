#pragma once
// Makes the scenes of the scaling benchmark, in which one number at a time grows and the others stay constant.

#include <filesystem>
#include <memory>

#include "core/progress.h"
#include "plan/view.h"

namespace defocus::engine {

// The world points to the scene.
struct ScalingWorld {
    std::shared_ptr<Scene> scene = std::make_shared<Scene>();
    World world;
    View view;  // the school's own camera, 640 × 480 px
};

// Returns the first eight fish of the built-in school with about `triangles` in total (1,600 … 80,000,000). Shapes and
// positions don't depend on the number of triangles. Pyramids are cached in `cacheFolder`, unless it is empty.
ScalingWorld schoolOf(std::uint64_t triangles, const std::filesystem::path& cacheFolder, const Progress& progress = {});

// Returns `count` fish of the built-in school, each with a mesh of its own of about `triangles` triangles.
ScalingWorld differentFish(int count, int triangles, const std::filesystem::path& cacheFolder,
                           const Progress& progress = {});

// Returns `instances` copies of one fish of about `triangles` before the same camera. The copies form a cubic grid that
// always fills the same part of the view. Each fish is as large as its cell: as the number of fish grows, each covers
// fewer pixels, and a layer of the grid covers about the same area.
ScalingWorld gridOf(int instances, int triangles, const std::filesystem::path& cacheFolder);

}  // namespace defocus::engine
