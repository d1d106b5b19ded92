#pragma once
// Computes a hash of all inputs of an image: the meshes, materials, textures, objects, lights and environment of a
// world, the view with its lens, and the shaders. Worlds with equal hashes give the same image.

#include <cstdint>
#include <filesystem>

#include "plan/view.h"

namespace defocus::engine {

// Returns the hash of world, view and shaders. `shaderFolder`: folder whose shaders replace the embedded ones; empty:
// none. Throws Error if that folder can't be read.
std::uint64_t worldHash(const World& world, const View& view, const std::filesystem::path& shaderFolder = {});

}  // namespace defocus::engine
