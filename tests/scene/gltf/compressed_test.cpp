// Compares scenes in Draco and meshopt files with the uncompressed scenes from which the files were made
// (tests/data/compressed).

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "models.h"
#include "scene/gltf/gltf.h"
#include "scene/posed_mesh.h"

namespace defocus::engine {
namespace {

// Mesh, posed vertices in world space, and bounds of a scene's first object.
struct Posed {
    Mesh mesh;
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    Bounds bounds;
};

Posed posedAt(const std::filesystem::path& path, double time) {
    const Scene scene = loadGltf(path);
    const Pose pose = poseAt(scene, time);
    const Object& object = pose.objects.at(0);
    Posed posed{scene.meshes.at(static_cast<std::size_t>(object.mesh)), {}, {}, pose.bounds};
    posed.positions = posedPositions(posed.mesh, object);
    posed.normals = posedNormals(posed.mesh, object);
    return posed;
}

double areaOf(const Posed& posed) {
    double area = 0;
    for (const Primitive& primitive : posed.mesh.primitives)
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            const glm::dvec3& a = posed.positions[primitive.indices[i]];
            area += 0.5 * glm::length(glm::cross(posed.positions[primitive.indices[i + 1]] - a,
                                                 posed.positions[primitive.indices[i + 2]] - a));
        }
    return area;
}

// Returns the max distance from a vertex of `from` to the nearest matching vertex of `to`. Vertices match if each
// colour channel differs by at most 2 of 255 and the normals by at most 3°. Vertices that share a position on a seam
// are thus compared separately.
double farthest(const Posed& from, const Posed& to) {
    double max = 0;
    for (std::size_t i = 0; i < from.positions.size(); ++i) {
        double min = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < to.positions.size(); ++k) {
            const glm::ivec4 a(glm::round(255.0f * from.mesh.vertices.colors[i]));
            const glm::ivec4 b(glm::round(255.0f * to.mesh.vertices.colors[k]));
            const int apart = std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
            if (apart <= 2 && glm::dot(from.normals[i], to.normals[k]) > 0.9986f)
                min = std::min(min, glm::length(from.positions[i] - to.positions[k]));
        }
        max = std::max(max, min);
    }
    return max;
}

struct CompressedCase {
    const char* file;
    const char* original;
};

class Compressed : public testing::TestWithParam<CompressedCase> {};

// Compressed files equal the originals up to the precision of the compression. glTF-Transform stores positions with 14
// bits over the longest side, so rounding moves a point by at most √3/2 of a step. Skin matrices, which include the
// scale of the steps, and offsets of morph targets are also rounded.
TEST_P(Compressed, isTheOriginalToItsPrecision) {
    const std::filesystem::path path = modelPath(std::filesystem::path("tests/data/compressed") / GetParam().file);
    const std::filesystem::path originalPath = modelPath(std::filesystem::path("meshes") / GetParam().original);
    for (const double time : {0.0, 0.3, 1.0}) {
        const Posed compressed = posedAt(path, time);
        const Posed original = posedAt(originalPath, time);
        ASSERT_EQ(compressed.mesh.triangleCount(), original.mesh.triangleCount());
        const glm::dvec3 size = original.bounds.size();
        const double step = std::max({size.x, size.y, size.z}) / ((1 << 14) - 1);
        const bool bends = deformed(poseAt(loadGltf(originalPath), time).objects.at(0));
        const double max = (bends ? 4 : 0.9) * step;
        EXPECT_LT(farthest(compressed, original), max) << time;
        EXPECT_LT(farthest(original, compressed), max) << time;
        EXPECT_NEAR(areaOf(compressed), areaOf(original), 1e-3 * areaOf(original)) << time;
    }
}

INSTANTIATE_TEST_SUITE_P(Gltf, Compressed,
                         testing::Values(CompressedCase{"fish-draco.glb", "fish.glb"},
                                         CompressedCase{"fish-draco-sequential.glb", "fish.glb"},
                                         CompressedCase{"fish-meshopt.glb", "fish.glb"},
                                         CompressedCase{"reed-meshopt.glb", "reed.glb"}),
                         [](const auto& tested) { return testNameOf(tested.param.file); });

}  // namespace
}  // namespace defocus::engine
