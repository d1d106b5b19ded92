#pragma once
// Which faces of a mesh have no place in a manifold as they are. They are drawn unchanged at level 0; coarser levels
// are made of the repaired surface (see manifold.h).

#include <cstdint>

#include "scene/mesh.h"

namespace defocus {

// Numbers of faces; one face may be among several kinds.
struct Repairs {
    std::uint32_t faces = 0;    // in all
    std::uint32_t dropped = 0;  // degenerate, or repetitions
    std::uint32_t turned = 0;   // wound against their neighbours
    std::uint32_t cut = 0;      // off, at an edge of more faces than two, or of two that can't agree
    std::uint32_t split = 0;    // off, at a vertex where several fans meet
};

Repairs repairsOf(const Mesh& mesh);

}  // namespace defocus
