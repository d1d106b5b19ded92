#pragma once
// Generates the mesh of one fish with vertex colours. The body, each fin and both eyes are closed surfaces with
// triangles of similar size.

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

// Returns a mesh of about `triangles` triangles with two primitives: body and fins (`skinMaterial`), and eyes
// (`eyeMaterial`). Units are metres. The origin lies inside the fish, the head points to +x, the back to +y.
Mesh fishMesh(const Fish& fish, int triangles, int skinMaterial, int eyeMaterial);

// Surface of a fish under construction: the fish is straight, and lengths are in body lengths. Shared by mesh.cpp and
// fins.cpp.
struct FishSurface {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec4> colors;
    std::vector<std::uint32_t> indices;

    void add(const glm::vec3& position, const glm::vec3& color);
};

}  // namespace defocus::engine
