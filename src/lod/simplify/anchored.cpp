#include "lod/simplify/anchored.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "lod/simplify/surface_mean.h"

namespace defocus {

namespace {

// A vertex whose normal stands square to its triangle's counts this much of its area.
constexpr float leastForeshortening = 0.02f;
// Normals of vertices that share an anchor and differ by more than 60° stand on two sides of an edge.
constexpr float leastSharedCosine = 0.5f;

}  // namespace

bool isUnused(const Anchor& anchor) {
    return anchor.weight[0] == 0 && anchor.weight[1] == 0 && anchor.weight[2] == 0;
}

Numbered<MeshVertexNumber, Anchored> anchoredValues(const FitSource& source,
                                                    const Numbered<MeshVertexNumber, Anchor>& anchors) {
    const Vertices& vertices = source.vertices;
    Numbered<MeshVertexNumber, Anchored> sums(anchors.size());
    for (const MeshVertexNumber v : anchors.numbers()) {
        const MeshVertexNumber other = anchors[v].sharedWith;
        Anchored& sum = sums[other.isValid() ? other : v];
        sum.area += source.areas[v];
        const glm::vec3& normal = vertices.normals[v.value];
        const glm::vec3& shared = vertices.normals[(other.isValid() ? other : v).value];
        const bool acrossEdge = glm::dot(normal, shared) < leastSharedCosine;
        sum.normal += source.areas[v] * (acrossEdge ? shared : normal);
        if (!vertices.colors.empty()) sum.color += source.areas[v] * vertices.colors[v.value];
    }
    for (Anchored& sum : sums) {
        if (!(sum.area > 0)) continue;
        sum.normal /= sum.area;
        sum.color /= sum.area;
    }
    return sums;
}

Numbered<TriangleNumber, glm::vec3> unitNormals(const std::vector<glm::vec3>& positions, const LevelMesh& level) {
    Numbered<TriangleNumber, glm::vec3> normals;
    normals.reserve(level.triangles.count());
    for (const TriangleNumber t : level.triangles.numbers()) {
        const glm::dvec3 normal = triangleCross(level.triangles.corners(t),
                                                [&](LevelVertexNumber v) { return positions[level.sources[v].value]; });
        const double length = glm::length(normal);
        normals.push_back(length > 0 ? glm::vec3(normal / length) : glm::vec3(0));
    }
    return normals;
}

float foreshortened(float area, const Anchor& anchor, const glm::vec3& face, const glm::vec3& normal) {
    const float* w = anchor.weight;
    const bool atCorner = w[0] == 1 || w[1] == 1 || w[2] == 1;
    if (atCorner || face == glm::vec3(0)) return area;
    return area * std::clamp(glm::dot(face, normal), leastForeshortening, 1.0f);
}

}  // namespace defocus
