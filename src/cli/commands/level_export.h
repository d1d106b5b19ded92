#pragma once
// Exports the levels of a mesh as separate mesh files for other programs.

#include <filesystem>
#include <string>
#include <vector>

#include "lod/pyramid/pyramid.h"
#include "scene/scene.h"

namespace defocus::engine {

// Returns a file name, without folder and extension, for each mesh of the scene. The names don't depend on which meshes
// are exported. No two names differ only in case, because some file systems ignore case.
std::vector<std::string> fileStems(const Scene& scene);

std::filesystem::path levelFile(const std::filesystem::path& folder, const std::string& stem, std::size_t level);

// Creates the folder before any long work. Throws Error if the folder or `firstFile` cannot be written.
void prepareFolder(const std::filesystem::path& folder, const std::filesystem::path& firstFile);

// Returns a level of a pyramid as a mesh, without materials, skin or morph targets.
Mesh levelMesh(const Pyramid& pyramid, std::size_t level, const std::string& name);

}  // namespace defocus::engine
