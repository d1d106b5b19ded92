#pragma once
// Pyramids: the levels of detail of a scene's meshes.

#include <cstdint>
#include <string>
#include <vector>

#include "defocus/export.h"
#include "defocus/progress.h"
#include "defocus/request.h"

namespace defocus {

// A level of detail of a mesh. Lengths are in the mesh's units.
struct PyramidLevel {
    std::uint32_t triangles = 0;
    std::uint32_t vertices = 0;
    double meanEdge = 0;
    double error = 0;  // upper bound of the 99th percentile of the surface's distances to level 0
};

struct Pyramid {
    std::string name;                  // name of the mesh
    std::uint64_t mesh = 0;            // index of the mesh in the file
    double diagonal = 0;               // diagonal of the mesh's bounding box, in mesh units
    std::uint32_t repairs = 0;         // number of repaired faces
    std::string end;                   // why the last level is the coarsest: "minTriangles", "topology" …
    std::vector<PyramidLevel> levels;  // level 0 is the full mesh
};

// Returns the pyramids of a request's scene: builds them or reads them from the cache. Needs no GPU. Throws the errors
// of SceneRenderer's constructor.
DEFOCUS_API std::vector<Pyramid> pyramids(const Request& request, const Progress& progress = {});

// Returns the pyramids as JSON: an object with the array `meshes`.
DEFOCUS_API std::string toJson(const std::vector<Pyramid>& pyramids);

}  // namespace defocus
