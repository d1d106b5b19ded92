#include "lod/simplify/level_growth.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace defocus {

namespace {

// A component of a level and how it is scaled.
struct Grown {
    double area = 0;
    Bounds box;
    double factor = 1;
    glm::dvec3 shift{0};  // back into level 0's box

    [[nodiscard]] glm::dvec3 place(const glm::dvec3& p, const glm::dvec3& centre) const {
        return centre + factor * (p - centre) + shift;
    }
};

void chooseGrowth(Grown& grown, const Growth& growth, const Bounds& limits) {
    if (!(growth.area > grown.area) || !(grown.area > 0)) return;
    grown.factor = std::min(std::sqrt(growth.area / grown.area), growth.mostFactor);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        if (const double size = grown.box.size()[axis]; size > 0)
            grown.factor = std::min(grown.factor, limits.size()[axis] / size);
    grown.factor = std::max(grown.factor, 1.0);
    grown.shift = glm::max(glm::dvec3(0), limits.minimum - grown.place(grown.box.minimum, growth.centre)) +
                  glm::min(glm::dvec3(0), limits.maximum - grown.place(grown.box.maximum, growth.centre));
}

}  // namespace

void growComponents(std::vector<glm::vec3>& positions, const SimplifiedLevel& level, const Bounds& limits) {
    if (level.growthsOf.empty()) return;
    std::vector<Grown> grown(level.growths.size());
    const std::vector<std::uint32_t>& indices = level.mesh.triangles.indices;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const glm::dvec3 a = positions[indices[i]];
        grown[level.growthsOf[indices[i]]].area +=
            0.5 * glm::length(
                      glm::cross(glm::dvec3(positions[indices[i + 1]]) - a, glm::dvec3(positions[indices[i + 2]]) - a));
    }
    for (std::size_t v = 0; v < positions.size(); ++v) grown[level.growthsOf[v]].box.extend(glm::dvec3(positions[v]));
    for (std::size_t g = 0; g < grown.size(); ++g) chooseGrowth(grown[g], level.growths[g], limits);
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const std::uint32_t g = level.growthsOf[v];
        if (grown[g].factor == 1) continue;
        const glm::vec3 moved(grown[g].place(glm::dvec3(positions[v]), level.growths[g].centre));
        positions[v] = glm::clamp(moved, glm::vec3(limits.minimum), glm::vec3(limits.maximum));
    }
}

}  // namespace defocus
