#pragma once
// Computes a hash of everything that an image shows: the meshes, materials, textures, objects, lights and environment
// of a world, the view with its lens, and the shaders. Worlds with equal hashes are expected to give the same picture.

#include <cstdint>
#include <filesystem>

#include "plan/view.h"

namespace defocus::engine {

// Returns the hash. `shaderFolder`: folder whose shaders replace the embedded ones; empty: none. Throws Error for a
// folder that can't be read.
std::uint64_t worldHash(const World& world, const View& view, const std::filesystem::path& shaderFolder = {});

}  // namespace defocus::engine
