#pragma once
// How well a collapse suits the mesh.

#include <cstdint>

namespace defocus {

// Collapses of a worse kind wait until no better one is left. See simplify.h for what makes one poor or bad.
enum class Fit : std::uint8_t { good, poor, bad, impossible };

}  // namespace defocus
