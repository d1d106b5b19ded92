#pragma once
// Implements the disk cache of pyramids (meshes with levels of detail): one file per mesh, named after its key
// (file.h). Several processes may use a folder at the same time. Defective files, symbolic links and pipes count as
// cache misses; the rebuilt pyramid replaces them.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// Returns $XDG_CACHE_HOME/defocus, or else $HOME/.cache/defocus. Returns an empty path if neither variable holds an
// absolute path.
std::filesystem::path defaultCacheFolder();

struct CachedPyramids {
    std::vector<Pyramid> pyramids;               // one pyramid per mesh, in the order of the meshes
    std::size_t loaded = 0;                      // number of pyramids loaded from the cache; the others were built
    std::vector<std::optional<double>> seconds;  // time to build each pyramid, s; nullopt if loaded from the cache
    std::string failure;                         // reason why a pyramid was not stored; empty on success
};

// Loads pyramids from `folder`; builds and stores the missing pyramids. Creates the folder if it is missing, with mode
// 0700. With an empty `folder`, builds all pyramids and stores none. A failure to store is not an error; after the
// first failure, no further pyramid is stored. Pyramids of meshes too small to be simplified are not stored.
CachedPyramids cachedPyramids(const std::vector<Mesh>& meshes, const std::filesystem::path& folder,
                              const PyramidOptions& options = {}, const Progress& progress = {});

// Loads the pyramid of one mesh. Returns nullopt if `folder` has no valid file for this mesh and these options.
std::optional<Pyramid> loadPyramid(const Mesh& mesh, const std::filesystem::path& folder,
                                   const PyramidOptions& options = {});

// Stores the pyramid of one mesh. If the file cannot be written, removes the incomplete file and throws Error. Throws
// std::bad_alloc if memory is exhausted.
void storePyramid(const Pyramid& pyramid, const Mesh& mesh, const std::filesystem::path& folder,
                  const PyramidOptions& options = {});

struct CacheFile {
    std::filesystem::path path;
    std::uint64_t bytes = 0;
    std::filesystem::file_time_type written;
    std::uint32_t triangles = 0;  // triangle count of the mesh at level 0
    bool pending = false;         // the file is still being written, or the writing process was killed
};

// Lists the cache files in `folder`, newest first. A cache file is recognised by its name and first bytes. Returns an
// empty list if the folder does not exist. Throws Error if the folder cannot be read.
std::vector<CacheFile> cacheFiles(const std::filesystem::path& folder);

// Removes the cache files in `folder` and returns them. Throws Error if a file cannot be removed.
std::vector<CacheFile> clearCache(const std::filesystem::path& folder);

}  // namespace defocus::engine
