// Tests that levels keep the blur attribute of vertices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lod/pyramid/pyramid.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

constexpr int cells = 48;

// Returns the blur in mm at a position: 0 on an oblique line, growing with the distance on both sides of the line.
float blurAt(const glm::vec3& p) {
    return 4 * std::abs(p.x - 0.3f * p.y);
}

Mesh plane(bool blurred) {
    Mesh mesh;
    for (int y = 0; y <= cells; ++y)
        for (int x = 0; x <= cells; ++x) {
            const glm::vec3 p(2.0f * static_cast<float>(x) / cells - 1, 2.0f * static_cast<float>(y) / cells - 1, 0);
            mesh.vertices.positions.push_back(p);
            mesh.vertices.normals.emplace_back(0, 0, 1);
            if (blurred) mesh.vertices.blurs.push_back({0, blurAt(p), blurAt(p)});
        }
    mesh.primitives.push_back({-1, gridIndices(cells)});
    mesh.blurBounds = boundsOf(mesh.vertices.blurs);
    return mesh;
}

// Returns the mean difference in mm, over the level's area, between the blur interpolated inside its triangles and
// blurAt().
double meanDeviation(const Pyramid& pyramid, std::size_t level) {
    double sum = 0;
    double area = 0;
    const IndexRange range = pyramid.levels[level].primitives[0];
    for (std::uint32_t i = range.first; i < range.first + range.count; i += 3) {
        glm::vec3 p[3];
        float blur[3];
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t v = pyramid.indices[i + k];
            p[k] = pyramid.levels[level].positions[v];
            blur[k] = pyramid.vertices.blurs.empty() ? blurAt(pyramid.vertices.positions[v])
                                                     : pyramid.vertices.blurs[v].opening;
        }
        const double size = std::abs((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x)) / 2;
        constexpr int steps = 8;
        for (int a = 0; a < steps; ++a)
            for (int b = 0; a + b < steps; ++b) {
                const float u = (static_cast<float>(a) + 0.33f) / steps, v = (static_cast<float>(b) + 0.33f) / steps;
                const glm::vec3 at = p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]);
                const float found = blur[0] + u * (blur[1] - blur[0]) + v * (blur[2] - blur[0]);
                sum += size * std::abs(double(found) - double(blurAt(at))) / (steps * (steps + 1) / 2);
            }
        area += size;
    }
    return sum / area;
}

TEST(VertexBlurOfLevels, isThatOfTheMesh) {
    const Pyramid blurred = buildPyramid(plane(true));
    const Pyramid plain = buildPyramid(plane(false));
    ASSERT_GE(blurred.levels.size(), 5u);
    EXPECT_EQ(blurred.vertices.blurs.size(), blurred.vertices.positions.size());
    const std::size_t last = std::min(blurred.levels.size(), plain.levels.size()) - 1;
    for (std::size_t level = 0; level <= last; ++level)
        EXPECT_LT(meanDeviation(blurred, level), 0.02) << "level " << level;
    EXPECT_LT(5 * meanDeviation(blurred, last), meanDeviation(plain, last))
        << "without blur, no vertex stays on the line";
}

}  // namespace
}  // namespace defocus::engine
