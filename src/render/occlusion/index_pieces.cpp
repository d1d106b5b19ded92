#include "render/occlusion/index_pieces.h"

namespace defocus::engine {

std::vector<IndexPiece> indexPieces(const Pyramid& pyramid, std::uint32_t level, std::uint32_t primitive) {
    const PyramidLevel& own = pyramid.levels[level];
    const IndexRange& all = own.primitives[primitive];
    std::vector<IndexPiece> pieces;
    for (const Cluster& cluster : own.clusters) {
        if (cluster.indices.first < all.first || cluster.indices.first >= all.first + all.count) continue;
        const std::uint32_t triangles = cluster.indices.count / 3;
        const std::uint32_t parts = (triangles + maxPieceTriangles - 1) / maxPieceTriangles;
        for (std::uint32_t part = 0; part < parts; ++part) {
            const std::uint32_t first = cluster.indices.first + 3 * (triangles * part / parts);
            const std::uint32_t end = cluster.indices.first + 3 * (triangles * (part + 1) / parts);
            Bounds box;
            for (std::uint32_t i = first; i < end; ++i) box.extend(glm::dvec3(own.positions[pyramid.indices[i]]));
            pieces.push_back({{first, end - first}, glm::vec3(box.centre()), glm::vec3(0.5 * box.size())});
        }
    }
    return pieces;
}

}  // namespace defocus::engine
