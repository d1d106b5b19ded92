#include "lod/simplify/repairs.h"

#include <vector>

#include "lod/simplify/manifold.h"

namespace defocus {

Repairs repairsOf(const Mesh& mesh) {
    TriangleSet triangles;
    triangles.indices.reserve(3 * mesh.triangleCount());
    for (const Primitive& primitive : mesh.primitives) {
        const std::size_t count = primitive.indices.size() / 3 * 3;
        triangles.indices.insert(triangles.indices.end(), primitive.indices.begin(),
                                 primitive.indices.begin() + static_cast<std::ptrdiff_t>(count));
        triangles.primitiveIndexCounts.push_back(static_cast<std::uint32_t>(count));
    }
    const Welded positions = weldPositions(mesh.vertices.positions);
    std::vector<glm::dvec3> points;
    points.reserve(positions.first.size());
    for (const std::uint32_t v : positions.first) points.emplace_back(mesh.vertices.positions[v]);
    return buildManifold(weldedTriangles(triangles, positions, points), points).repairs;
}

}  // namespace defocus
