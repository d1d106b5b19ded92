#pragma once
// The disk cache of pyramids: one file a mesh, named after its key (file.h). Several processes may use a folder
// at once. Whatever is wrong with a file is a miss, and the pyramid is built again and replaces it.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// $XDG_CACHE_HOME/defocus, else $HOME/.cache/defocus; empty where the environment has neither (as absolute paths).
std::filesystem::path defaultCacheFolder();

struct CachedPyramids {
    std::vector<Pyramid> pyramids;  // one a mesh
    std::size_t loaded = 0;         // how many of them; the rest was built
    std::string failure;            // why a built one wasn't stored; empty where nothing went wrong
};

// Does what buildPyramids does, but takes from `folder` the pyramids that it holds and stores there those that it
// doesn't; with an empty `folder` there is no cache. A missing folder is made. A pyramid that can't be stored is no
// fault; after the first, no other is tried. Meshes that are too small to be simplified are not stored.
CachedPyramids cachedPyramids(const std::vector<Mesh>& meshes, const std::filesystem::path& folder,
                              const PyramidOptions& options = {}, const Progress& progress = {});

// Loads one pyramid. Returns nothing if the folder doesn't have it whole and sound.
std::optional<Pyramid> loadPyramid(const Mesh& mesh, const std::filesystem::path& folder,
                                   const PyramidOptions& options = {});

// Stores one pyramid. Throws Error where it can't be written, and std::bad_alloc; no half file stays.
void storePyramid(const Pyramid& pyramid, const Mesh& mesh, const std::filesystem::path& folder,
                  const PyramidOptions& options = {});

struct CacheFile {
    std::filesystem::path path;
    std::uint64_t bytes = 0;
    std::filesystem::file_time_type written;
    std::uint32_t triangles = 0;  // of the mesh
    bool pending = false;         // being written, or left by a process that was killed
};

// Lists the files of `folder` that the cache wrote, told by name and first bytes, newest first; none where there is no
// such folder. Throws Error where the folder can't be read.
std::vector<CacheFile> cacheFiles(const std::filesystem::path& folder);

// Removes those files and returns them. Throws Error for one that can't be removed.
std::vector<CacheFile> clearCache(const std::filesystem::path& folder);

}  // namespace defocus::engine
