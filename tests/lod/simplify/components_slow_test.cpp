// Tests the simplification of a ball beside small parts that have many handles (tunnels).

#include <gtest/gtest.h>

#include "lod/invariants.h"
#include "lod/shapes.h"

namespace defocus::engine {
namespace {

Mesh ballAndSlabs(std::uint32_t count, std::uint32_t holes, float size) {
    Mesh mesh;
    addPart(mesh, sphere(192, 96), 1, {});
    for (std::uint32_t i = 0; i < count; ++i)
        addPart(mesh, slab(holes + i % 3, 3), size * (1 + 0.1f * static_cast<float>(i % 4)),
                glm::vec3(1.5f) + 2 * size * static_cast<float>(count) * scatteredPlace(i));
    return mesh;
}

// Small slabs with many holes need many triangles. The ball must nevertheless keep its shape in every level in which a
// slab has more triangles than the ball.
TEST(Components, ABallOutlastsSmallPartsOfManyHandles) {
    struct Scene {
        std::uint32_t count, holes;
        float size;
    };
    for (const Scene& scene : {Scene{1, 30, 0.2f}, {3, 18, 0.2f}, {12, 5, 0.1f}, {40, 3, 0.05f}}) {
        SCOPED_TRACE(testing::Message() << scene.count << " slabs of " << scene.holes << " holes or more");
        const Mesh mesh = ballAndSlabs(scene.count, scene.holes, scene.size);
        const Pyramid pyramid = buildPyramid(mesh);
        expectPyramidInvariants(mesh, pyramid);
        ASSERT_TRUE(isClosed(pyramid.levels[0].positions, levelIndices(pyramid, 0)));
        expectMainPartLasts(mesh, pyramid);
        EXPECT_LE(pyramid.levels.back().triangleCount, 64u);
    }
}

}  // namespace
}  // namespace defocus::engine
