// Tests the scene's data on the GPU: shared buffers of small meshes, the contents of the buffers, and uniform blocks of
// materials.

#include <set>

#include "gl/gl_test.h"
#include "render/gpu_scene/gpu_scene.h"
#include "render/gpu_scene/material_blocks.h"
#include "render/gpu_scene/vertex_arrays.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

class GpuSceneTest : public GlTest {
protected:
    static constexpr int quads = 300;

    // Makes a world of many quads at different depths and a sphere. The sphere is too large to share buffers.
    GpuSceneTest() {
        for (int i = 0; i < quads; ++i) {
            small_.scene.meshes.push_back(quad(-1));
            for (glm::vec3& position : small_.scene.meshes.back().vertices.positions) position.z = shift(i);
        }
        small_.scene.meshes.push_back(bumpySphere(80, 60, -1));
        finish(small_);
    }

    static float shift(int mesh) { return static_cast<float>(mesh) / 512; }

    // Returns a plan that draws the quads at level of detail 0 and the sphere at `levelOfSphere`.
    [[nodiscard]] FramePlan planWith(std::size_t levelOfSphere) const {
        FramePlan plan;
        for (std::size_t mesh = 0; mesh < small_.world.pyramids.size(); ++mesh) {
            plan.objects.emplace_back().mesh = static_cast<int>(mesh);
            plan.levelsUsed.emplace_back(small_.world.pyramids[mesh].levels.size()).front() = mesh < quads;
        }
        plan.levelsUsed.back()[levelOfSphere] = true;
        return plan;
    }

    template <typename T>
    static std::vector<T> valuesOf(const Buffer& buffer, std::size_t first, std::size_t count) {
        std::vector<T> values(count);
        buffer.read(first * sizeof(T), count * sizeof(T), values.data());
        return values;
    }

    SmallWorld small_;
};

TEST_F(GpuSceneTest, smallMeshesShareBuffersAndVertexArrays) {
    GpuScene scene(small_.world);
    scene.prepare(planWith(0));
    std::set<const MeshBuffers*> buffers;
    std::set<const VertexArray*> arrays;
    VertexArrays vertexArrays;
    for (int i = 0; i < quads; ++i) {
        buffers.insert(scene.mesh(i).buffers.get());
        arrays.insert(&vertexArrays.attach(scene.mesh(i), 0));
    }
    EXPECT_EQ(buffers.size(), 1u);
    EXPECT_EQ(arrays.size(), 1u);
    EXPECT_FALSE(buffers.contains(scene.mesh(quads).buffers.get()));
    EXPECT_FALSE(arrays.contains(&vertexArrays.attach(scene.mesh(quads), 0)));  // only the sphere has vertex colours
}

TEST_F(GpuSceneTest, sharedBuffersHoldEachMesh) {
    GpuScene scene(small_.world);
    scene.prepare(planWith(0));
    for (const int i : {0, 1, 150, quads - 1}) {
        const GpuMesh& mesh = scene.mesh(i);
        const Pyramid& pyramid = small_.world.pyramids[static_cast<std::size_t>(i)];
        const auto positions = valuesOf<glm::vec3>(mesh.buffers->vertices[positionLocation], mesh.levels[0].firstVertex,
                                                   pyramid.levels[0].vertexCount);
        for (std::size_t v = 0; v < positions.size(); ++v)
            EXPECT_EQ(glm::dvec3(positions[v]) + mesh.origin, glm::dvec3(pyramid.levels[0].positions[v])) << i;
        EXPECT_EQ(positions.front().z + static_cast<float>(mesh.origin.z), shift(i));
        EXPECT_EQ(valuesOf<std::uint32_t>(mesh.buffers->indices, mesh.levels[0].firstIndex, pyramid.indices.size()),
                  pyramid.indices);
    }
}

TEST_F(GpuSceneTest, furtherLevelsOfAMeshLeaveTheOthersInPlace) {
    GpuScene scene(small_.world);
    scene.prepare(planWith(1));
    const std::size_t bytes = scene.bytes();
    const MeshBuffers* const ofQuads = scene.mesh(0).buffers.get();
    EXPECT_FALSE(scene.mesh(quads).levels[0].uploaded);
    scene.prepare(planWith(0));
    EXPECT_TRUE(scene.mesh(quads).levels[0].uploaded);
    EXPECT_TRUE(scene.mesh(quads).levels[1].uploaded);
    EXPECT_EQ(scene.mesh(0).buffers.get(), ofQuads);
    EXPECT_GT(scene.bytes(), bytes);
    const auto& level = small_.world.pyramids.back().levels[1];
    EXPECT_EQ(valuesOf<glm::vec3>(scene.mesh(quads).buffers->vertices[normalLocation],
                                  scene.mesh(quads).levels[1].firstVertex, level.vertexCount),
              level.normals);
}

TEST_F(GpuSceneTest, materialsWithoutUvTransformsTakeNoUvRows) {
    small_.scene.materials.resize(100);
    const GpuScene scene(small_.world);
    std::vector<int> materials(100);
    for (int i = 0; i < 100; ++i) materials[static_cast<std::size_t>(i)] = i;
    EXPECT_EQ(MaterialBlocks(scene, materials).bytes(), 100 * uniformStride(sizeof(GpuMaterial)));
    small_.scene.materials[7].baseColor = {0, 1, {}};
    EXPECT_EQ(MaterialBlocks(scene, materials).bytes(),
              99 * uniformStride(sizeof(GpuMaterial)) + uniformStride(sizeof(GpuTransformedMaterial)));
}

}  // namespace
}  // namespace defocus::engine
