#pragma once
// Small surfaces as the simplifier holds them, and their faces as they can be written down.

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "lod/simplify/smoothing_groups.h"
#include "lod/simplify/state.h"

namespace defocus {

using Face = std::array<int, 3>;

// A mesh with a Simplifier of it; neither can be moved.
struct DrawnSurface {
    Vertices vertices;
    TriangleSet triangles;
    Welded positions;
    std::vector<std::uint32_t> smoothing;
    Simplifier simplifier;

    DrawnSurface(Vertices drawn, const std::vector<std::vector<std::uint32_t>>& primitives)
        : vertices(std::move(drawn)) {
        for (const auto& indices : primitives) {
            triangles.indices.insert(triangles.indices.end(), indices.begin(), indices.end());
            triangles.primitiveIndexCounts.push_back(static_cast<std::uint32_t>(indices.size()));
        }
        if (vertices.normals.empty()) vertices.normals = smoothNormals(vertices.positions, triangles.indices);
        positions = weldPositions(vertices.positions);
        smoothing = smoothingGroups(vertices.normals, positions.id);
        prepareSimplifier(simplifier, vertices, positions, smoothing, triangles);
    }
    DrawnSurface(const DrawnSurface&) = delete;
    DrawnSurface& operator=(const DrawnSurface&) = delete;

    [[nodiscard]] SurfaceMesh& mesh() { return *simplifier.mesh; }
    [[nodiscard]] CollapseModules& modules() { return *simplifier.modules; }

    // The half-edge between the places of two mesh vertices.
    [[nodiscard]] HalfedgeHandle edge(std::uint32_t from, std::uint32_t to) {
        return mesh().find_halfedge(simplifier.origin->firstVertex[from], simplifier.origin->firstVertex[to]);
    }
    void collapse(std::uint32_t from, std::uint32_t to) { collapseEdge(simplifier, edge(from, to)); }
};

// The living faces as the mesh vertices that they draw, each from its smallest on, sorted.
inline std::vector<Face> drawnFaces(const SurfaceMesh& mesh) {
    std::vector<Face> faces;
    forEachFace(mesh, [&](FaceHandle handle) {
        Face& face = faces.emplace_back();
        const FaceCorners corners = cornersOf(mesh, handle);
        for (std::size_t i = 0; i < 3; ++i) face[i] = static_cast<int>(mesh.wedges.source(mesh.wedge(corners.at[i])));
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    });
    std::sort(faces.begin(), faces.end());
    return faces;
}

}  // namespace defocus
