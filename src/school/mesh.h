#pragma once
// The mesh of one fish: a closed surface each for the body, every fin and both eyes, with vertex colours, all of evenly
// sized triangles.

#include <cstdint>
#include <string>
#include <vector>

#include "scene/mesh.h"
#include "school/pattern.h"
#include "school/shape.h"

namespace defocus::engine {

struct Fish {
    std::string species;
    FishShape shape;
    FishPattern pattern;
};

// Two primitives: body with fins (`skinMaterial`) and eyes (`eyeMaterial`), of about `triangles` triangles together.
// Metres; the origin lies in the fish, its head points along +x, its back along +y.
Mesh fishMesh(const Fish& fish, int triangles, int skinMaterial, int eyeMaterial);

// The parts being assembled (body lengths, unbent), for fish_mesh.cpp and fish_fins.cpp.
struct FishSurface {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec4> colors;
    std::vector<std::uint32_t> indices;

    void add(const glm::vec3& position, const glm::vec3& color);
};

}  // namespace defocus::engine
