#pragma once
// Builds small surfaces in the simplifier's data structure, and lists their faces for comparison.

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "lod/numbered.h"
#include "lod/simplify/state.h"

namespace defocus::engine {

using Face = std::array<int, 3>;

// A mesh with its Simplifier. Objects of this type cannot be copied or moved.
struct DrawnSurface {
    Vertices vertices;
    TriangleSet<MeshVertexNumber> triangles;
    WeldedPositions positions;
    VertexGroups smoothing;
    Simplifier simplifier;

    DrawnSurface(Vertices drawn, const std::vector<std::vector<std::uint32_t>>& primitives)
        : vertices(std::move(drawn)), triangles(numberedTriangles<MeshVertexNumber>(primitives)) {
        std::vector<std::uint32_t> all;
        for (const auto& indices : primitives) all.insert(all.end(), indices.begin(), indices.end());
        if (vertices.normals.empty()) vertices.normals = smoothNormals(vertices.positions, all);
        positions = weldPositions(vertices.positions);
        smoothing = smoothingGroups(vertices.normals, positions);
        prepareSimplifier(simplifier, vertices, positions, smoothing, triangles);
    }
    DrawnSurface(const DrawnSurface&) = delete;
    DrawnSurface& operator=(const DrawnSurface&) = delete;

    [[nodiscard]] SurfaceMesh& mesh() { return *simplifier.mesh; }
    [[nodiscard]] CollapseModules& modules() { return *simplifier.modules; }

    // These two functions return the surface's vertex for a mesh vertex, and the half-edge between two mesh vertices.
    // The handles are valid until the next compact().
    [[nodiscard]] VertexHandle vertex(std::uint32_t v) const {
        return simplifier.current[simplifier.origin->firstVertex[{v}]];
    }
    [[nodiscard]] HalfedgeHandle edge(std::uint32_t from, std::uint32_t to) {
        return mesh().find_halfedge(vertex(from), vertex(to));
    }
    void collapse(std::uint32_t from, std::uint32_t to) { collapseEdge(simplifier, edge(from, to)); }
};

// Returns the remaining faces in sorted order. A face is given by the mesh vertices at its corners, in winding order
// from the lowest vertex index.
inline std::vector<Face> drawnFaces(const SurfaceMesh& mesh) {
    std::vector<Face> faces;
    forEachFace(mesh, [&](FaceHandle handle) {
        Face& face = faces.emplace_back();
        const FaceCorners corners = cornersOf(mesh, handle);
        for (std::size_t i = 0; i < 3; ++i)
            face[i] = static_cast<int>(mesh.wedges.source(mesh.wedge(corners.at[i])).value);
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    });
    std::sort(faces.begin(), faces.end());
    return faces;
}

}  // namespace defocus::engine
