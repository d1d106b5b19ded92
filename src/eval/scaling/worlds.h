#pragma once
// Makes the scenes of the scaling benchmark, so that one number at a time can grow while the rest stays.

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

// Returns the first eight fish of the built-in school with about `triangles` in all (1,600 … 80,000,000). Shapes and
// places don't depend on the number of triangles. Pyramids are kept in `cacheFolder`, unless it is empty.
ScalingWorld schoolOf(std::uint64_t triangles, const std::filesystem::path& cacheFolder, const Progress& progress = {});

// Returns `count` fish of the built-in school with about `triangles` each, every one with a mesh of its own.
ScalingWorld differentFish(int count, int triangles, const std::filesystem::path& cacheFolder,
                           const Progress& progress = {});

// Returns `instances` copies of one fish of about `triangles`, before the same camera. They stand on a grid with as
// many columns and rows as layers behind each other, which always fills the same part of the view. Each fish is as
// large as its cell, so a fish covers fewer pixels as their number grows, and a layer covers about as many as before.
ScalingWorld gridOf(int instances, int triangles, const std::filesystem::path& cacheFolder);

}  // namespace defocus::engine
