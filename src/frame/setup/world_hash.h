#pragma once
// Computes one number for everything that an image shows: the meshes, materials, textures, objects, lights and
// surroundings of a world, the view with its lens, and the shaders that draw it. Worlds with equal numbers may be
// expected to give the same picture.

#include <cstdint>
#include <filesystem>

#include "plan/view.h"

namespace defocus::engine {

// Returns that number. `shaderFolder`: shaders read from there replace the embedded ones; empty: none. Throws Error for
// one that can't be read.
std::uint64_t worldHash(const World& world, const View& view, const std::filesystem::path& shaderFolder = {});

}  // namespace defocus::engine
