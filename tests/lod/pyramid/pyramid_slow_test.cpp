// Tests the levels of detail of thin sheets that are meshed at many resolutions.

#include <gtest/gtest.h>

#include <cmath>

#include "lod/pyramid/pyramid.h"
#include "lod/shapes.h"

namespace defocus::engine {
namespace {

TEST(Pyramid, BothSidesOfAThinSheetKeepTheirNormals) {
    for (std::uint32_t cells = 44; cells <= 84; cells += 2) {
        const Pyramid pyramid = buildPyramid(thinSheet(cells));
        ASSERT_LE(pyramid.levels.back().triangleCount, 256u);
        for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
            const PyramidLevel& level = pyramid.levels[l];
            const std::vector<std::uint32_t> indices = levelIndices(pyramid, l);
            for (std::size_t i = 0; i < indices.size(); i += 3) {
                const glm::vec3& a = level.positions[indices[i]];
                const glm::vec3 cross =
                    glm::cross(level.positions[indices[i + 1]] - a, level.positions[indices[i + 2]] - a);
                // skips triangles of the rim
                if (glm::length(cross) < 1e-3f || std::abs(glm::normalize(cross).z) < 0.9f) continue;
                glm::vec3 mean(0);
                for (std::size_t k = 0; k < 3; ++k) mean += level.normals[indices[i + k]] / 3.0f;
                EXPECT_GT(glm::dot(mean, glm::normalize(cross)), 0.6f) << cells << " cells, level " << l;
            }
        }
    }
}

}  // namespace
}  // namespace defocus::engine
