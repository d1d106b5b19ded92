#pragma once
// The levels of a mesh as files of their own, for other programs.

#include <filesystem>
#include <string>
#include <vector>

#include "lod/pyramid/pyramid.h"
#include "scene/scene.h"

namespace defocus::engine {

// A file's name without folder and extension for each mesh of the scene, whatever is exported of it; they differ in
// more than case, which some file systems ignore.
std::vector<std::string> fileStems(const Scene& scene);

std::filesystem::path levelFile(const std::filesystem::path& folder, const std::string& stem, std::size_t level);

// Makes the folder, before the work that ends in it. Throws Error where it can't be or no file can be written there.
void prepareFolder(const std::filesystem::path& folder, const std::filesystem::path& firstFile);

// A level as a mesh, without materials, skin and morph targets.
Mesh levelMesh(const Pyramid& pyramid, std::size_t level, const std::string& name);

}  // namespace defocus::engine
