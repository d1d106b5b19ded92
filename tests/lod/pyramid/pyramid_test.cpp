#include "lod/pyramid/pyramid.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "core/error.h"
#include "likeness.h"
#include "lod/invariants.h"
#include "lod/pyramid/build_all.h"
#include "lod/shapes.h"

namespace defocus::engine {
namespace {

TEST(Pyramid, EmptyMeshHasOneEmptyLevel) {
    const Pyramid pyramid = buildPyramid(Mesh{});
    ASSERT_EQ(pyramid.levels.size(), 1u);
    EXPECT_EQ(pyramid.levels[0].triangleCount, 0u);
    EXPECT_TRUE(pyramid.indices.empty());
    EXPECT_TRUE(pyramid.bounds.empty());
}

TEST(Pyramid, SingleTriangleStaysAlone) {
    Vertices vertices;
    vertices.positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
    const Mesh mesh = singlePrimitive(vertices, {0, 1, 2});
    const Pyramid pyramid = buildPyramid(mesh);
    expectPyramidInvariants(mesh, pyramid);
    ASSERT_EQ(pyramid.levels.size(), 1u);
    EXPECT_DOUBLE_EQ(pyramid.levels[0].meanEdge, 4);  // the mean of the edge lengths 3, 4 and 5
    EXPECT_EQ(pyramid.bounds.maximum, glm::dvec3(3, 4, 0));
}

TEST(Pyramid, IndexBeyondTheVerticesIsAnError) {
    Vertices vertices;
    vertices.positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
    vertices.normals.assign(3, {0, 0, 1});
    EXPECT_THROW(buildPyramid(singlePrimitive(vertices, {0, 1, 3})), Error);
}

TEST(Pyramid, HalvesAClosedSphereWithASeamDownToItsFloorAndKeepsItClosed) {
    const Mesh mesh = sphere(64, 32, 0.1);
    const Pyramid pyramid = buildPyramid(mesh);
    expectPyramidInvariants(mesh, pyramid);
    EXPECT_EQ(pyramid.repairedFaces, 0u);
    for (std::size_t l = 0; l < pyramid.levels.size(); ++l)
        EXPECT_TRUE(isClosed(pyramid.levels[l].positions, levelIndices(pyramid, l))) << "level " << l;
    // The levels have 3968, 1984, 992, 496, 248, 124 and 64 triangles.
    ASSERT_EQ(pyramid.levels.size(), 7u);
    EXPECT_EQ(pyramid.levels[3].triangleCount, 496u);
    EXPECT_EQ(pyramid.levels.back().triangleCount, 64u);
}

TEST(Pyramid, KeepsATorusWithTwoSeamsClosed) {
    const Mesh mesh = torus(48, 24);
    const Pyramid pyramid = buildPyramid(mesh);
    expectPyramidInvariants(mesh, pyramid);
    for (std::size_t l = 0; l < pyramid.levels.size(); ++l) {
        const std::vector<std::uint32_t> indices = levelIndices(pyramid, l);
        EXPECT_TRUE(isClosed(pyramid.levels[l].positions, indices)) << "level " << l;
        // A torus has V − E + F = 0, so it has half as many vertices as faces.
        std::map<PositionKey, int> positions;
        for (const std::uint32_t v : indices) ++positions[keyOf(pyramid.vertices.positions[v])];
        EXPECT_EQ(positions.size(), indices.size() / 6) << "level " << l;
    }
    EXPECT_EQ(pyramid.levels.back().triangleCount, 64u);
}

double volume(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices) {
    double sum = 0;
    for (std::size_t i = 0; i < indices.size(); i += 3)
        sum += glm::dot(glm::dvec3(positions[indices[i]]),
                        glm::cross(glm::dvec3(positions[indices[i + 1]]), glm::dvec3(positions[indices[i + 2]]))) /
               6;
    return sum;
}

// A polyhedron with vertices on a sphere lies inside the sphere. A level with fitted vertices loses at most a third of
// the volume that the inscribed polyhedron loses.
TEST(Pyramid, LevelsOfASphereKeepItsVolume) {
    const Pyramid pyramid = buildPyramid(sphere(96, 48));
    const double full = volume(pyramid.vertices.positions, levelIndices(pyramid, 0));
    ASSERT_GT(pyramid.levels.size(), 5u);
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        const std::vector<std::uint32_t> indices = levelIndices(pyramid, l);
        const double inscribed = full - volume(pyramid.vertices.positions, indices);
        EXPECT_LT(std::abs(full - volume(pyramid.levels[l].positions, indices)), inscribed / 3) << "level " << l;
    }
}

// The rim of a thin sheet survives in all levels: it has almost no area, but forms the entire outline.
TEST(Pyramid, AThinSheetIsNotCutBackAtItsRim) {
    const Pyramid pyramid = buildPyramid(thinSheet(64));
    for (std::size_t l = 0; l < pyramid.levels.size(); ++l)
        EXPECT_NEAR(surfaceArea(pyramid.levels[l].positions, levelIndices(pyramid, l)), 2, 0.04) << "level " << l;
}

TEST(Pyramid, DrawsNoTriangleAcrossASeam) {
    // A triangle with corners on both sides of the UV seam would span nearly the entire texture.
    const Mesh mesh = torus(96, 48);
    const Pyramid pyramid = buildPyramid(mesh);
    for (std::size_t l = 0; l + 2 < pyramid.levels.size(); ++l) {
        const std::vector<std::uint32_t> indices = levelIndices(pyramid, l);
        for (std::size_t i = 0; i < indices.size(); i += 3)
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::vec2 step =
                    pyramid.vertices.uv0[indices[i + k]] - pyramid.vertices.uv0[indices[i + (k + 1) % 3]];
                ASSERT_LT(std::max(std::abs(step.x), std::abs(step.y)), 0.75f) << "level " << l;
            }
    }
}

TEST(Pyramid, BorderBetweenTwoPrimitivesStaysShut) {
    // The sphere's southern and northern halves belong to two primitives with separate vertices.
    Mesh mesh = sphere(48, 24);
    const Mesh full = mesh;
    const auto count = static_cast<std::uint32_t>(mesh.vertices.count());
    const auto appendAgain = [&](auto& values) {
        auto copy = values;
        values.insert(values.end(), copy.begin(), copy.end());
    };
    appendAgain(mesh.vertices.positions);
    appendAgain(mesh.vertices.normals);
    appendAgain(mesh.vertices.uv0);
    // Different texture coordinates prevent the simplifier from joining the duplicate vertices.
    for (std::size_t v = count; v < mesh.vertices.count(); ++v) mesh.vertices.uv0[v].x += 2;
    mesh.primitives = {{0, {}}, {1, {}}};
    for (std::size_t i = 0; i < full.primitives[0].indices.size(); i += 3) {
        const std::uint32_t* v = &full.primitives[0].indices[i];
        const float z =
            mesh.vertices.positions[v[0]].z + mesh.vertices.positions[v[1]].z + mesh.vertices.positions[v[2]].z;
        for (std::size_t k = 0; k < 3; ++k) mesh.primitives[z > 0].indices.push_back(z > 0 ? v[k] + count : v[k]);
    }

    const Pyramid pyramid = buildPyramid(mesh);
    expectPyramidInvariants(mesh, pyramid);
    EXPECT_EQ(pyramid.levels.back().triangleCount, 64u);
    for (std::size_t l = 0; l < pyramid.levels.size(); ++l) {
        SCOPED_TRACE(testing::Message() << "level " << l);
        EXPECT_TRUE(isClosed(pyramid.levels[l].positions, levelIndices(pyramid, l)));
        for (std::size_t p = 0; p < 2; ++p) {
            const IndexRange& range = pyramid.levels[l].primitives[p];
            EXPECT_GT(range.count, 0u);
            for (std::uint32_t i = range.first; i < range.first + range.count; ++i)
                ASSERT_EQ(pyramid.source[pyramid.indices[i]] >= count, p == 1) << "a vertex of the other primitive";
        }
    }
}

TEST(Pyramid, FlatSquareIsTiledAtEveryLevel) {
    const Mesh mesh = flatGrid(48);
    const Pyramid pyramid = buildPyramid(mesh);
    expectPyramidInvariants(mesh, pyramid);
    EXPECT_LE(pyramid.levels.back().triangleCount, 64u);
    for (std::size_t l = 0; l < pyramid.levels.size(); ++l) {
        SCOPED_TRACE(testing::Message() << "level " << l);
        EXPECT_NEAR(surfaceArea(pyramid.levels[l].positions, levelIndices(pyramid, l)), 1, 1e-6);
        for (const glm::vec3& normal : pyramid.levels[l].normals) ASSERT_NEAR(normal.z, 1, 1e-6);
        if (l == 0) continue;
        EXPECT_NEAR(pyramid.levels[l].error, std::sqrt(2.0) * 1e-6 * std::pow(1.25, l - 1), 1e-12);
    }
}

// Expects every level of a flat mesh to lie in the plane z = 0 and to have the area `area`. `side` is the mesh's size.
void expectFlatLevels(const Mesh& mesh, double area, double side) {
    const Pyramid pyramid = buildPyramid(mesh);
    for (std::size_t l = 0; l < pyramid.levels.size(); ++l) {
        const std::vector<std::uint32_t> indices = levelIndices(pyramid, l);
        EXPECT_NEAR(surfaceArea(pyramid.levels[l].positions, indices) / area, 1, 1e-5) << "level " << l;
        for (const std::uint32_t v : indices)
            ASSERT_LE(std::abs(static_cast<double>(pyramid.levels[l].positions[v].z)), 1e-5 * side) << "level " << l;
    }
}

// The sides include huge and tiny lengths, lengths that floats cannot represent exactly, and slivers.
TEST(Pyramid, FlatGridsOfAnySizeAreTiledAtEveryLevel) {
    for (const glm::dvec2& sides :
         {glm::dvec2(1e6), glm::dvec2(1e-6), glm::dvec2(0.1), glm::dvec2(0.7), glm::dvec2(1, 1e-3)}) {
        SCOPED_TRACE(testing::Message() << sides.x << " × " << sides.y << " m");
        Mesh mesh = flatGrid(48);
        mesh.vertices.uv0.clear();
        for (glm::vec3& p : mesh.vertices.positions) p *= glm::vec3(glm::vec2(sides), 1);
        expectFlatLevels(mesh, sides.x * sides.y, sides.x);
    }
}

TEST(Pyramid, TrianglesWithoutAreaDoNotChangeAFlatGrid) {
    Mesh mesh = flatGrid(24);
    mesh.vertices.uv0.clear();
    std::vector<std::uint32_t>& indices = mesh.primitives[0].indices;
    for (std::uint32_t i = 0; i < 100; ++i) indices.insert(indices.end(), {i, i, i + 1});     // repeated index
    for (std::uint32_t i = 0; i < 20; ++i) indices.insert(indices.end(), {i, i + 1, i + 2});  // collinear corners
    expectFlatLevels(mesh, 1, 1);
}

TEST(Pyramid, FlatSquareGetsEvenTriangles) {
    // If n right-angled triangles fill a unit square, their edges have a mean length of about 1.14·√(2/n). Slivers
    // would have far longer edges.
    const Pyramid pyramid = buildPyramid(flatGrid(64));
    for (const PyramidLevel& level : pyramid.levels)
        EXPECT_LT(level.meanEdge, 2.2 * std::sqrt(2.0 / level.triangleCount)) << level.triangleCount;
}

TEST(Pyramid, StoredErrorOfASphereCoversTheDistanceOfItsFaces) {
    // A fitted face intersects the unit sphere: its corners lie outside, its centre inside. The distance of a point p
    // from the sphere is | |p| − 1 |.
    const Pyramid pyramid = buildPyramid(sphere(128, 64));
    for (std::size_t l = 3; l < pyramid.levels.size(); ++l) {
        std::vector<double> distances;
        const std::vector<std::uint32_t> indices = levelIndices(pyramid, l);
        const auto& p = pyramid.levels[l].positions;
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            for (std::size_t k = 0; k < 3; ++k) distances.push_back(std::abs(glm::length(p[indices[i + k]]) - 1));
            distances.push_back(1 - glm::length(p[indices[i]] + p[indices[i + 1]] + p[indices[i + 2]]) / 3);
        }
        std::sort(distances.begin(), distances.end());
        const double median = distances[distances.size() / 2];
        EXPECT_GT(pyramid.levels[l].error, median) << "level " << l;
        EXPECT_LT(pyramid.levels[l].error, 6 * median) << "level " << l;
    }
}

TEST(Pyramid, NormalsOfASphereStayRadial) {
    const Pyramid pyramid = buildPyramid(sphere(64, 32));
    for (std::size_t l = 0; l + 1 < pyramid.levels.size(); ++l) {
        const PyramidLevel& level = pyramid.levels[l];
        double worst = 1;
        for (const std::uint32_t v : levelIndices(pyramid, l))
            worst = std::min<double>(worst, glm::dot(level.normals[v], glm::normalize(pyramid.vertices.positions[v])));
        EXPECT_GT(worst, l < 4 ? 0.95 : 0.85) << "level " << l;
    }
}

TEST(Pyramid, CubeWithHardEdgesStaysACube) {
    // The mesh is a cube of six grids of 12 × 12 cells, which share positions but not normals along the cube's edges.
    Mesh mesh;
    mesh.primitives.resize(1);
    for (int face = 0; face < 6; ++face) {
        const Mesh grid = flatGrid(12);
        const auto first = static_cast<std::uint32_t>(mesh.vertices.count());
        const int axis = face / 2;
        for (std::size_t v = 0; v < grid.vertices.count(); ++v) {
            const glm::vec3& g = grid.vertices.positions[v];
            glm::vec3 p(0);
            p[(axis + 1) % 3] = face % 2 == 0 ? g.y : g.x;
            p[(axis + 2) % 3] = face % 2 == 0 ? g.x : g.y;
            p[axis] = face % 2 == 0 ? 0.0f : 1.0f;
            glm::vec3 normal(0);
            normal[axis] = face % 2 == 0 ? -1.0f : 1.0f;
            mesh.vertices.positions.push_back(p);
            mesh.vertices.normals.push_back(normal);
            mesh.vertices.uv0.push_back(grid.vertices.uv0[v]);
        }
        for (const std::uint32_t index : grid.primitives[0].indices)
            mesh.primitives[0].indices.push_back(first + index);
    }
    const Pyramid pyramid = buildPyramid(mesh);
    expectPyramidInvariants(mesh, pyramid);
    EXPECT_EQ(pyramid.levels.back().triangleCount, 64u);
    for (std::size_t l = 0; l < pyramid.levels.size(); ++l) {
        const std::vector<std::uint32_t> indices = levelIndices(pyramid, l);
        EXPECT_TRUE(isClosed(pyramid.levels[l].positions, indices)) << "level " << l;
        EXPECT_NEAR(surfaceArea(pyramid.levels[l].positions, indices), 6, 1e-5) << "level " << l;
        for (const std::uint32_t v : indices)
            ASSERT_NEAR(glm::dot(pyramid.levels[l].normals[v], pyramid.vertices.normals[v]), 1, 1e-5) << "level " << l;
    }
}

TEST(Pyramid, SoupOfLooseTrianglesComesDownToTheFloor) {
    Vertices vertices;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 300; ++i) {
        const std::uint32_t triangle = i / 3;
        const auto x = static_cast<float>(2 * triangle);
        vertices.positions.push_back({x + static_cast<float>(i % 3 == 1), static_cast<float>(i % 3 == 2), x});
        indices.push_back(i);
    }
    const Mesh mesh = singlePrimitive(vertices, indices);
    const Pyramid pyramid = buildPyramid(mesh);
    expectPyramidInvariants(mesh, pyramid);
    // The 100 triangles share no vertices, so only complete triangles can be removed. Level 1 has 64 triangles, the
    // minimum for a level, because half of 100 triangles would be fewer.
    ASSERT_EQ(pyramid.levels.size(), 2u);
    EXPECT_EQ(pyramid.levels[1].triangleCount, 64u);
}

TEST(Pyramid, SurvivesWhatHalfEdgesCannotHold) {
    // The mesh is a sphere with a fin on an edge, a repeated face, a degenerate face, a reversed copy of every face (a
    // two-sided sheet), and a NaN corner.
    Mesh mesh = sphere(32, 16);
    std::vector<std::uint32_t>& indices = mesh.primitives[0].indices;
    const std::vector<std::uint32_t> clean = indices;
    const auto apex = static_cast<std::uint32_t>(mesh.vertices.count());
    mesh.vertices.positions.insert(mesh.vertices.positions.end(),
                                   {{3, 0, 0}, {std::numeric_limits<float>::quiet_NaN(), 0, 0}});
    mesh.vertices.normals.insert(mesh.vertices.normals.end(), 2, {1, 0, 0});
    mesh.vertices.uv0.insert(mesh.vertices.uv0.end(), 2, {0, 0});
    const std::uint32_t a = clean[300];
    const std::uint32_t b = clean[301];
    indices.insert(indices.end(), {a, b, apex});
    indices.insert(indices.end(), {clean[300], clean[301], clean[302]});
    indices.insert(indices.end(), {a, a, b});
    for (std::size_t i = 0; i < clean.size(); i += 3)
        indices.insert(indices.end(), {clean[i], clean[i + 2], clean[i + 1]});
    const Mesh withoutNaN = mesh;
    const Pyramid pyramid = buildPyramid(withoutNaN);
    expectPyramidInvariants(withoutNaN, pyramid);
    EXPECT_GT(pyramid.repairedFaces, 2u);
    EXPECT_GT(pyramid.levels.size(), 3u);

    indices.insert(indices.end(), {a, b, apex + 1});
    const Pyramid withNaN = buildPyramid(mesh);
    EXPECT_EQ(withNaN.levels[0].triangleCount, mesh.triangleCount());
    EXPECT_EQ(withNaN.bounds.maximum.x, 3);
    for (std::size_t l = 1; l < withNaN.levels.size(); ++l)
        for (const std::uint32_t v : levelIndices(withNaN, l))
            ASSERT_TRUE(std::isfinite(withNaN.vertices.positions[v].x));
}

TEST(Pyramid, WindingAgainstTheNeighboursIsKeptAsItIs) {
    // The winding of every third triangle is reversed. At every level, adjacent triangles must still share complete
    // edges.
    Mesh mesh = sphere(32, 16);
    std::vector<std::uint32_t>& indices = mesh.primitives[0].indices;
    for (std::size_t i = 0; i < indices.size(); i += 9) std::swap(indices[i], indices[i + 1]);
    const Pyramid pyramid = buildPyramid(mesh);
    expectPyramidInvariants(mesh, pyramid);
    EXPECT_EQ(pyramid.repairedFaces, (indices.size() / 3 + 2) / 3);
    for (std::size_t l = 0; l < pyramid.levels.size(); ++l)
        for (const auto& [edge, use] : edgeUses(pyramid.vertices.positions, levelIndices(pyramid, l)))
            ASSERT_EQ(use.count, 2) << "level " << l;
}

TEST(Pyramid, ScaleAndPlaceOfTheUnitDoNotMatter) {
    const Mesh mesh = sphere(48, 24, 0.1);
    const Pyramid pyramid = buildPyramid(mesh);
    for (const int exponent : {-20, 20}) {  // scales the mesh by about 1e-6 and 1e6; powers of two are exact
        Mesh scaled = mesh;
        for (glm::vec3& p : scaled.vertices.positions) p *= std::ldexp(1.0f, exponent);
        const Pyramid other = buildPyramid(scaled);
        EXPECT_TRUE(sameBits(other.indices, pyramid.indices)) << exponent;
        ASSERT_EQ(other.levels.size(), pyramid.levels.size());
        for (std::size_t l = 0; l < other.levels.size(); ++l) {
            EXPECT_DOUBLE_EQ(other.levels[l].meanEdge, std::ldexp(pyramid.levels[l].meanEdge, exponent));
            EXPECT_DOUBLE_EQ(other.levels[l].error, std::ldexp(pyramid.levels[l].error, exponent));
        }
    }
}

TEST(Pyramid, SameMeshGivesTheSameBitsAloneAndAmongOthers) {
    const Mesh mesh = decorated(sphere(48, 24, 0.1));
    const Pyramid first = buildPyramid(mesh);
    std::vector<Pyramid> many = buildPyramids({torus(24, 12), mesh, Mesh{}, mesh, sphere(16, 8)});
    ASSERT_EQ(many.size(), 5u);
    EXPECT_EQ(many[0].levels[0].triangleCount, 576u);
    // The mesh's pyramid is built twice more, without other meshes: by buildPyramids(), and by buildPyramid() with
    // several threads.
    many.push_back(std::move(buildPyramids({mesh}).front()));
    many.push_back(buildPyramid(mesh, {}, 3));
    for (const std::size_t i : {1u, 3u, 5u, 6u}) {
        EXPECT_TRUE(sameBits(many[i].indices, first.indices));
        EXPECT_TRUE(sameBits(many[i].vertices.positions, first.vertices.positions));
        EXPECT_TRUE(sameBits(many[i].source, first.source));
        ASSERT_EQ(many[i].levels.size(), first.levels.size());
        for (std::size_t l = 0; l < first.levels.size(); ++l) {
            EXPECT_TRUE(sameBits(many[i].levels[l].normals, first.levels[l].normals));
            EXPECT_EQ(many[i].levels[l].error, first.levels[l].error);
            EXPECT_EQ(many[i].levels[l].meanEdge, first.levels[l].meanEdge);
        }
    }
}

TEST(Pyramid, AttributesFollowTheirVertices) {
    const Mesh mesh = decorated(sphere(24, 12));
    const Pyramid pyramid = buildPyramid(mesh);
    expectPyramidInvariants(mesh, pyramid);
    for (std::size_t v = 0; v < pyramid.vertices.count(); ++v) {
        const std::uint32_t s = pyramid.source[v];
        ASSERT_EQ(pyramid.vertices.normals[v], mesh.vertices.normals[s]);
        ASSERT_EQ(pyramid.vertices.tangents[v], mesh.vertices.tangents[s]);
        ASSERT_EQ(pyramid.vertices.uv0[v], mesh.vertices.uv0[s]);
        ASSERT_EQ(pyramid.vertices.uv1[v], mesh.vertices.uv1[s]);
        ASSERT_EQ(pyramid.vertices.colors[v], mesh.vertices.colors[s]);
        ASSERT_EQ(pyramid.vertices.joints[v], mesh.vertices.joints[s]);
        ASSERT_EQ(pyramid.vertices.weights[v], mesh.vertices.weights[s]);
    }
}

TEST(Pyramid, UnsharedVerticesAreJoinedAndUnusedOnesDropped) {
    const Mesh shared = sphere(24, 12);
    Mesh mesh;
    mesh.primitives.resize(1);
    mesh.vertices.positions.push_back({9, 9, 9});
    mesh.vertices.normals.push_back({0, 0, 1});
    mesh.vertices.uv0.push_back({0, 0});
    for (const std::uint32_t v : shared.primitives[0].indices) {
        mesh.primitives[0].indices.push_back(static_cast<std::uint32_t>(mesh.vertices.count()));
        mesh.vertices.positions.push_back(shared.vertices.positions[v]);
        mesh.vertices.normals.push_back(shared.vertices.normals[v]);
        mesh.vertices.uv0.push_back(shared.vertices.uv0[v]);
    }
    const Pyramid pyramid = buildPyramid(mesh);
    expectPyramidInvariants(mesh, pyramid);
    EXPECT_EQ(pyramid.vertices.count(), buildPyramid(shared).vertices.count());
    EXPECT_LE(pyramid.bounds.maximum.x, 1);
    EXPECT_EQ(pyramid.levels.back().triangleCount, 64u);
}

// A mesh with duplicate vertices gets the same levels as the mesh without them. If there are many duplicates, a copy of
// the mesh without them is simplified. If there are few, they stay in the vertex list, but no triangle uses them.
TEST(Pyramid, CopiesOfVerticesChangeNothing) {
    const Mesh mesh = sphere(48, 24, 0.1);
    const Pyramid without = buildPyramid(mesh);
    for (const std::size_t stride : {3, 97}) {
        Mesh copied = mesh;
        std::vector<std::uint32_t>& indices = copied.primitives[0].indices;
        for (std::size_t i = 0; i < indices.size(); i += stride) {
            const std::uint32_t v = indices[i];
            indices[i] = static_cast<std::uint32_t>(copied.vertices.count());
            copied.vertices.positions.push_back(mesh.vertices.positions[v]);
            copied.vertices.normals.push_back(mesh.vertices.normals[v]);
            copied.vertices.uv0.push_back(mesh.vertices.uv0[v]);
        }
        const Pyramid with = buildPyramid(copied);
        expectPyramidInvariants(copied, with);
        EXPECT_EQ(with.source, without.source) << stride;
        EXPECT_EQ(with.indices, without.indices) << stride;
        ASSERT_EQ(with.levels.size(), without.levels.size()) << stride;
        for (std::size_t l = 0; l < with.levels.size(); ++l)
            for (std::size_t v = 0; v < with.levels[l].positions.size(); ++v)
                ASSERT_LT(glm::distance(with.levels[l].positions[v], without.levels[l].positions[v]), 1e-4) << stride;
    }
}

TEST(Pyramid, VerticesThatDifferOnlyInAMorphTargetStayApart) {
    Mesh mesh = flatGrid(1);
    mesh.vertices.uv0.clear();
    mesh.vertices.positions.push_back(mesh.vertices.positions[0]);
    mesh.vertices.normals.push_back(mesh.vertices.normals[0]);
    mesh.primitives[0].indices[0] = 4;  // the first corner at vertex 0 now uses the duplicate, vertex 4
    mesh.morphTargets.push_back({std::vector<glm::vec3>(5, {0, 0, 0}), {}, {}});
    EXPECT_EQ(buildPyramid(mesh).vertices.count(), 4u);
    mesh.morphTargets[0].positions[4] = {0, 0, 1};
    EXPECT_EQ(buildPyramid(mesh).vertices.count(), 5u);
}

TEST(FullDetail, HasEveryTriangleAndNoFurtherLevel) {
    const Mesh mesh = sphere(32, 16);
    const Pyramid pyramid = fullDetail(mesh);
    expectPyramidInvariants(mesh, pyramid);
    EXPECT_EQ(pyramid.levels.size(), 1u);
    EXPECT_EQ(pyramid.levels[0].triangleCount, mesh.triangleCount());
}

// Progress within one mesh is reported in more than 20 steps, so that a progress bar does not appear stuck.
TEST(PyramidProgress, movesInSmallStepsWithinOneMesh) {
    const std::vector<Mesh> meshes = {sphere(160, 120), sphere(8, 6)};
    std::vector<double> shares = {0};
    buildPyramids(meshes, {}, [&](std::string_view, std::uint64_t done, std::uint64_t total) {
        shares.push_back(static_cast<double>(done) / static_cast<double>(total));
    });
    EXPECT_GT(shares.size(), 20u);
    for (std::size_t i = 1; i < shares.size(); ++i) {
        EXPECT_GE(shares[i], shares[i - 1]);
        EXPECT_LT(shares[i] - shares[i - 1], 0.17);
    }
    EXPECT_EQ(shares.back(), 1);
    EXPECT_EQ(std::ranges::count(shares, 1.0), 1);
}

}  // namespace
}  // namespace defocus::engine
