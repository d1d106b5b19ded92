// Tests that the collapse modules implement OpenMesh's interface: OpenMesh's decimater can use them, and their
// guarantees hold.

#include <gtest/gtest.h>

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lod/shapes.h"
#include "lod/simplify/drawn_surface.h"

namespace defocus::engine {
namespace {

using Decimater = OpenMesh::Decimater::DecimaterT<SurfaceMesh>;
template <typename Module>
using ModuleHandle = OpenMesh::Decimater::ModHandleT<Module>;

struct Decimated {
    Decimater decimater;
    ModuleHandle<ShapeModule> shape;
    ModuleHandle<WedgeModule> wedges;
    ModuleHandle<QuadricModule> quadrics;

    explicit Decimated(SurfaceMesh& mesh) : decimater(mesh) {
        decimater.add(shape);
        decimater.add(wedges);
        decimater.add(quadrics);
        decimater.initialize();
    }
};

// Expects the wedge (vertex with attributes) of each face corner to have the position of the corner's vertex.
void expectWedgesInPlace(const DrawnSurface& surface, const SurfaceMesh& mesh) {
    forEachFace(mesh, [&](FaceHandle face) {
        for (const HalfedgeHandle corner : cornersOf(mesh, face))
            ASSERT_EQ(surface.vertices.positions[mesh.wedges.source(mesh.wedge(corner)).value],
                      mesh.position(mesh.from_vertex_handle(corner)));
    });
}

std::size_t livingFaces(const SurfaceMesh& mesh) {
    std::size_t count = 0;
    forEachFace(mesh, [&](FaceHandle) { ++count; });
    return count;
}

TEST(Decimater, bringsASphereDownWithOurModules) {
    const Mesh sphereMesh = sphere(48, 24, 0.1);
    DrawnSurface surface(sphereMesh.vertices, {sphereMesh.primitives[0].indices});
    SurfaceMesh& mesh = surface.mesh();
    Decimated run(mesh);
    ASSERT_TRUE(run.decimater.is_initialized());
    ASSERT_GT(run.decimater.decimate_to_faces(0, 300), 0u);
    EXPECT_LE(livingFaces(mesh), 300u);
    EXPECT_GE(livingFaces(mesh), 298u);
    expectWedgesInPlace(surface, mesh);

    // The surface is still closed: each edge has one face on either side, and faces point outwards.
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    forEachFace(mesh, [&](FaceHandle face) {
        for (const HalfedgeHandle corner : cornersOf(mesh, face)) {
            indices.push_back(static_cast<std::uint32_t>(positions.size()));
            positions.push_back(mesh.position(mesh.from_vertex_handle(corner)));
        }
    });
    EXPECT_TRUE(isClosed(positions, indices));
    for (std::size_t i = 0; i < positions.size(); i += 3) {
        const glm::vec3 normal = glm::cross(positions[i + 1] - positions[i], positions[i + 2] - positions[i]);
        ASSERT_GT(glm::dot(normal, positions[i] + positions[i + 1] + positions[i + 2]), 0);
    }
}

// The decimater's first collapse is the cheapest that the modules allow.
TEST(Decimater, collapsesTheCheapestFirst) {
    const Mesh sphereMesh = sphere(24, 12, 0.1);
    DrawnSurface surface(sphereMesh.vertices, {sphereMesh.primitives[0].indices});
    SurfaceMesh& mesh = surface.mesh();
    CollapseModules& own = surface.modules();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    std::vector<float> costs(mesh.n_vertices(), infinity);
    forEachVertex(mesh, [&](VertexHandle v) {
        forEachSpoke(mesh, v, [&](HalfedgeHandle spoke) {
            if (!own.shape.keepsTopology(spoke)) return;
            if (std::max(own.shape.judge(spoke), own.wedges.judge(spoke)) >= Fit::bad) return;
            costs[indexOf(v)] = std::min(costs[indexOf(v)], own.quadrics.cost(spoke, infinity));
        });
    });
    Decimated run(mesh);
    ASSERT_EQ(run.decimater.decimate(1), 1u);
    const float min = *std::min_element(costs.begin(), costs.end());
    std::size_t gone = 0;
    for (std::size_t v = 0; v < costs.size(); ++v) {
        if (mesh.isAlive(VertexHandle(static_cast<int>(v)))) continue;
        ++gone;
        EXPECT_EQ(costs[v], min);
    }
    EXPECT_EQ(gone, 1u);
    expectWedgesInPlace(surface, mesh);
}

// A fan of thousands of spokes is not simplified, since each collapse at its hub would visit all spokes.
TEST(ShapeModule, leavesTheSpokesOfAHugeFanAlone) {
    const auto fan = [](std::uint32_t spokes) {
        Vertices vertices;
        vertices.positions.emplace_back(0, 0, 0);
        std::vector<std::uint32_t> indices;
        for (std::uint32_t i = 0; i < spokes; ++i) {
            const double angle = 2 * std::numbers::pi * i / spokes;
            vertices.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
            indices.insert(indices.end(), {0, i + 1, (i + 1) % spokes + 1});
        }
        return singlePrimitive(std::move(vertices), std::move(indices));
    };
    EXPECT_EQ(buildPyramid(fan(8200)).levels.size(), 1u);
    EXPECT_GT(buildPyramid(fan(800)).levels.size(), 1u);
}

// The border between two materials stays in place, since no face corner may get a wedge (vertex with attributes) of
// another material. In the test, a square of one material lies inside another material.
TEST(Decimater, leavesMaterialBordersToTheModules) {
    const Mesh grid = flatGrid(8);
    std::vector<std::vector<std::uint32_t>> primitives(2);
    Vertices vertices = grid.vertices;
    const auto count = static_cast<std::uint32_t>(vertices.count());
    for (std::size_t i = 0; i < grid.primitives[0].indices.size(); i += 3) {
        glm::vec3 middle(0);
        for (std::size_t k = 0; k < 3; ++k) middle += vertices.positions[grid.primitives[0].indices[i + k]] / 3.0f;
        const bool inner = std::max(std::abs(middle.x - 0.5f), std::abs(middle.y - 0.5f)) < 0.25f;
        for (std::size_t k = 0; k < 3; ++k)
            primitives[inner ? 1 : 0].push_back(grid.primitives[0].indices[i + k] + (inner ? count : 0));
    }
    const auto twice = [](auto& values) {
        const auto copy = values;
        values.insert(values.end(), copy.begin(), copy.end());
    };
    twice(vertices.positions);
    twice(vertices.normals);
    twice(vertices.uv0);
    DrawnSurface surface(vertices, primitives);
    SurfaceMesh& mesh = surface.mesh();
    Decimated run(mesh);
    ASSERT_GT(run.decimater.decimate_to_faces(0, 24), 0u);
    double innerArea = 0;
    forEachFace(mesh, [&](FaceHandle face) {
        const bool inner = mesh.primitive(face).value == 1;
        std::vector<glm::vec3> corners;
        for (const HalfedgeHandle corner : cornersOf(mesh, face)) {
            EXPECT_EQ(mesh.wedges.source(mesh.wedge(corner)).value >= count, inner);
            corners.push_back(mesh.position(mesh.from_vertex_handle(corner)));
        }
        if (inner) innerArea += 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    });
    EXPECT_NEAR(innerArea, 0.25, 1e-6);
}

}  // namespace
}  // namespace defocus::engine
