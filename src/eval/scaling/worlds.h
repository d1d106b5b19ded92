#pragma once
// Builds the scenes of the scaling benchmark: schools and grids of fish with a chosen number of fish or triangles.

#include <filesystem>
#include <memory>

#include "core/progress.h"
#include "plan/view.h"

namespace defocus::engine {

// A scene, and the World that draws it with its pyramids.
struct ScalingWorld {
    std::shared_ptr<Scene> scene = std::make_shared<Scene>();
    World world;
    View view;  // view of the default camera of the built-in school of fish, 640 × 480 px
};

// Returns a school of eight fish with about `triangles` in total (1,600 … 80,000,000). Shapes and positions don't
// depend on the number of triangles. Pyramids are cached in `cacheFolder`; empty: no cache.
ScalingWorld schoolOf(std::uint64_t triangles, const std::filesystem::path& cacheFolder, const Progress& progress = {});

// Returns a school of `count` fish, each with its own mesh of about `triangles` triangles.
ScalingWorld differentFish(int count, int triangles, const std::filesystem::path& cacheFolder,
                           const Progress& progress = {});

// Returns `instances` instances of one fish of about `triangles` triangles, with the default camera of the built-in
// school of fish. The instances form a cubic grid that always fills the same part of the view frustum. Each fish fills
// its cell of the grid. With more fish, each fish covers fewer pixels, while a layer of the grid covers about the same
// area of the image.
ScalingWorld gridOf(int instances, int triangles, const std::filesystem::path& cacheFolder);

}  // namespace defocus::engine
