// How far is what is left from the mesh? Every vertex that is gone has a survivor; its distance to the survivor's faces
// bounds its distance to the level. The 99th percentile over a sample of the vertices stands for the level.

#include <algorithm>
#include <cmath>

#include "lod/simplify_state.h"
#include "lod/triangle_distance.h"

namespace defocus {

namespace {

using OpenMesh::VertexHandle;

constexpr std::size_t mostSamples = 4096;  // vertices looked at a level
constexpr double percentile = 0.99;

std::uint32_t survivorOf(Simplifier& s, std::uint32_t v) {
    while (s.survivors[v] != v) v = s.survivors[v] = s.survivors[s.survivors[v]];
    return v;
}

}  // namespace

double deviation(Simplifier& s) {
    std::vector<double> squaredDistances;
    const std::size_t stride = std::max<std::size_t>(1, s.points.size() / mostSamples);
    for (std::size_t v = 0; v < s.points.size(); v += stride) {
        const std::uint32_t survivor = survivorOf(s, static_cast<std::uint32_t>(v));
        facesAround(s, vertexHandle(survivor), s.facesFrom);
        const glm::dvec3& p = s.points[v];
        glm::dvec3 offset = p - s.points[survivor];
        double least = glm::dot(offset, offset);
        for (const std::uint32_t face : s.facesFrom) {
            const std::uint32_t* corner = &s.corners.vertex[3 * std::size_t{face}];
            offset = p - closestPoint(p, s.points[corner[0]], s.points[corner[1]], s.points[corner[2]]);
            least = std::min(least, glm::dot(offset, offset));  // NaN of a degenerate face is passed over
        }
        squaredDistances.push_back(least);
    }
    const auto rank = static_cast<std::ptrdiff_t>(percentile * static_cast<double>(squaredDistances.size() - 1));
    std::nth_element(squaredDistances.begin(), squaredDistances.begin() + rank, squaredDistances.end());
    return std::sqrt(squaredDistances[static_cast<std::size_t>(rank)]) * s.scale;
}

}  // namespace defocus
