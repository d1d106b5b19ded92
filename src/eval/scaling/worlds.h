#pragma once
// The scenes of the scaling benchmark: made here, so that one number at a time can grow while the rest stays.

#include <filesystem>
#include <memory>

#include "core/progress.h"
#include "plan/view.h"

namespace defocus {

// The world points to the scene.
struct ScalingWorld {
    std::shared_ptr<Scene> scene = std::make_shared<Scene>();
    World world;
    View view;  // the school's own camera; size: 640 × 480 px
};

// The first eight fish of the built-in school, of `triangles` in all, about (1,600 … 80,000,000): the same shapes at
// the same places whatever their number. Pyramids come from the cache in `cacheFolder` or go there (empty: none).
ScalingWorld schoolOf(std::uint64_t triangles, const std::filesystem::path& cacheFolder, const Progress& progress = {});

// One fish of about `triangles`, `instances` times, before the same camera: on a grid of as many columns and rows as
// layers behind each other, which always fills the same part of the view. A fish is as large as its cell: the pixels
// that it covers shrink as they become more, and all together they cover about as many a layer.
ScalingWorld gridOf(int instances, int triangles, const std::filesystem::path& cacheFolder);

}  // namespace defocus
