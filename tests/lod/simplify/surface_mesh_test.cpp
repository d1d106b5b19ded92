#include "lod/simplify/surface_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lod/shapes.h"
#include "lod/simplify/drawn_surface.h"

namespace defocus::engine {
namespace {

// Expects each half-edge to agree with its opposite, its next half-edge and its face. Expects each vertex to refer to a
// half-edge that leaves the vertex, and to the boundary half-edge if the vertex lies on a border.
void expectLinked(const SurfaceMesh& mesh) {
    for (int i = 0; i < static_cast<int>(mesh.n_halfedges()); ++i) {
        const HalfedgeHandle h(i);
        if (!mesh.isAlive(mesh.edge_handle(h))) continue;
        const HalfedgeHandle next = mesh.next_halfedge_handle(h);
        ASSERT_EQ(mesh.prev_halfedge_handle(next), h);
        ASSERT_EQ(mesh.from_vertex_handle(next), mesh.to_vertex_handle(h));
        ASSERT_EQ(mesh.face_handle(next), mesh.face_handle(h));
        ASSERT_TRUE(mesh.isAlive(mesh.to_vertex_handle(h)));
        ASSERT_EQ(mesh.wedge(h).isValid(), !mesh.is_boundary(h));
        if (mesh.is_boundary(h)) {
            ASSERT_EQ(mesh.halfedge_handle(mesh.from_vertex_handle(h)), h);
        } else {
            ASSERT_TRUE(mesh.isAlive(mesh.face_handle(h)));
            ASSERT_EQ(mesh.next_halfedge_handle(mesh.next_halfedge_handle(next)), h);
        }
    }
    forEachVertex(mesh, [&](VertexHandle v) { ASSERT_EQ(mesh.from_vertex_handle(mesh.halfedge_handle(v)), v); });
}

DrawnSurface drawn(const Mesh& mesh) {
    return {mesh.vertices, {mesh.primitives[0].indices}};
}

TEST(SurfaceMesh, holdsTheFacesOfAGridWithItsBorder) {
    DrawnSurface surface = drawn(flatGrid(2));
    expectLinked(surface.mesh());
    EXPECT_EQ(surface.mesh().n_faces(), 8u);
    EXPECT_EQ(surface.mesh().n_edges(), 16u);
    EXPECT_EQ(surface.mesh().n_vertices(), 9u);
    EXPECT_EQ(
        drawnFaces(surface.mesh()),
        (std::vector<Face>{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 7}, {3, 7, 6}, {4, 5, 8}, {4, 8, 7}}));
}

TEST(SurfaceMesh, facesWoundAgainstTheOthersRunWithThem) {
    Mesh mesh = flatGrid(2);
    std::swap(mesh.primitives[0].indices[4], mesh.primitives[0].indices[5]);
    DrawnSurface surface = drawn(mesh);
    expectLinked(surface.mesh());
    EXPECT_TRUE(surface.mesh().data(FaceHandle(1)).isTurned());
    EXPECT_FALSE(surface.mesh().data(FaceHandle(0)).isTurned());
    EXPECT_EQ(drawnFaces(surface.mesh())[1], (Face{0, 4, 3}));
}

// Two edges may join the same two vertices a and b. Four points p stand around the axis a–b at 0°, 170°, 180° and 350°.
// Faces a–b–p join the points at 0° and 170° across one edge a–b, and the points at 180° and 350° across the other. The
// other faces join two neighbouring points p with a or b, and close the surface.
TEST(SurfaceMesh, holdsTwoEdgesBetweenTwoVertices) {
    Vertices vertices;
    vertices.positions = {{0, 0, 1}, {0, 0, -1}};
    for (const double degrees : {0.0, 170.0, 180.0, 350.0}) {
        const double angle = degrees * std::numbers::pi / 180;
        vertices.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    DrawnSurface surface(vertices, {{0, 2, 1, 0, 1, 3, 0, 3, 4, 1, 4, 3, 0, 4, 1, 0, 1, 5, 0, 5, 2, 1, 2, 5}});
    SurfaceMesh& mesh = surface.mesh();
    expectLinked(mesh);
    ASSERT_EQ(mesh.n_vertices(), 6u);
    EXPECT_EQ(mesh.n_edges(), 12u);
    const VertexHandle a = surface.vertex(0);
    const VertexHandle b = surface.vertex(1);
    int between = 0;
    forEachSpoke(mesh, a, [&](HalfedgeHandle spoke) {
        if (mesh.to_vertex_handle(spoke) != b) return;
        ++between;
        EXPECT_FALSE(surface.modules().shape.keepsTopology(spoke)) << "a collapse would turn one edge into a loop";
    });
    EXPECT_EQ(between, 2);
}

TEST(SurfaceMesh, livingCopyKeepsTheOrder) {
    DrawnSurface surface = drawn(flatGrid(4));
    const std::vector<std::pair<std::uint32_t, std::uint32_t>> collapses = {{6, 7}, {16, 11}, {0, 1}};
    for (const auto& [from, to] : collapses) {
        ASSERT_TRUE(surface.modules().shape.keepsTopology(surface.edge(from, to)));
        surface.collapse(from, to);
        expectLinked(surface.mesh());
    }
    const SurfaceMesh& mesh = surface.mesh();
    std::vector<glm::vec3> positions;
    std::vector<std::vector<MeshVertexNumber>> faces;  // for each face, the source vertices of its corners
    const auto sourcesOf = [](const SurfaceMesh& of, FaceHandle face) {
        std::vector<MeshVertexNumber> sources;
        for (const HalfedgeHandle corner : cornersOf(of, face)) sources.push_back(of.wedges.source(of.wedge(corner)));
        return sources;
    };
    forEachVertex(mesh, [&](VertexHandle v) { positions.push_back(mesh.position(v)); });
    forEachFace(mesh, [&](FaceHandle face) { faces.push_back(sourcesOf(mesh, face)); });
    ASSERT_EQ(positions.size(), 22u);
    // Two collapses inside the surface remove two of the 32 faces each, and one collapse at the border removes one.
    ASSERT_EQ(faces.size(), 27u);

    compact(surface.simplifier);
    const SurfaceMesh& copy = surface.mesh();
    expectLinked(copy);
    ASSERT_EQ(copy.n_vertices(), positions.size());
    ASSERT_EQ(copy.n_faces(), faces.size());
    EXPECT_EQ(copy.wedges.size(), positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v)
        EXPECT_EQ(copy.position(VertexHandle(static_cast<int>(v))), positions[v]);
    for (std::size_t f = 0; f < faces.size(); ++f)
        EXPECT_EQ(sourcesOf(copy, FaceHandle(static_cast<int>(f))), faces[f]);
    EXPECT_EQ(surface.vertex(6), surface.vertex(7));
    EXPECT_EQ(copy.position(surface.vertex(6)), surface.vertices.positions[7]);
}

}  // namespace
}  // namespace defocus::engine
