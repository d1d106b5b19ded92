#pragma once
// A quick stand-in for a mesh, to be shown while its pyramid is being built: meshoptimizer's simplifier, and its sloppy
// one (vertices that share a cell of a grid become one) where the first comes to no end, as with triangles that share
// no vertices. Nothing is fitted or measured.

#include <cstdint>

#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// Makes one level of about `triangles` triangles (up to half as many more). Its vertices are some of the mesh's
// (`source` says which), with joints and morph targets. A mesh that has no more is kept as it is; a primitive that no
// cell can show is left out.
Pyramid draftPyramid(const Mesh& mesh, std::uint32_t triangles);

}  // namespace defocus::engine
