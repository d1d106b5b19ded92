// Tests that levels of thin wires keep the projected area of the wires.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>

#include "lod/pyramid/pyramid.h"
#include "lod/simplify/cover_grid.h"

namespace defocus::engine {
namespace {

constexpr int wireCount = 28;
constexpr int wireRings = 120;
constexpr double wireRadius = 0.002;

// Returns parallel, slanted hexagonal wires in the plane z = 0, from y = 0 to y = 1. Each hexagon has two corners in
// the plane.
Mesh slantedWires() {
    Mesh mesh;
    Primitive& primitive = mesh.primitives.emplace_back();
    for (int wire = 0; wire < wireCount; ++wire)
        for (int ring = 0; ring < wireRings; ++ring) {
            const double share = ring / (wireRings - 1.0);
            const auto first = static_cast<std::uint32_t>(mesh.vertices.positions.size());
            for (std::uint32_t k = 0; k < 6; ++k) {
                const double turn = std::numbers::pi * k / 3;
                mesh.vertices.positions.emplace_back(0.031 * wire + 0.1 * share + wireRadius * std::cos(turn), share,
                                                     wireRadius * std::sin(turn));
                if (ring + 1 == wireRings) continue;
                const std::uint32_t a = first + k, b = first + (k + 1) % 6;
                primitive.indices.insert(primitive.indices.end(), {a, a + 6, b, b, a + 6, b + 6});
            }
        }
    return mesh;
}

// Seen along z, each wire covers an area of its width 2r times its height 1, at any slant.
TEST(ThinWires, aLevelCoversTheirArea) {
    const Pyramid pyramid = buildPyramid(slantedWires(), {.maxLevels = 2});
    ASSERT_EQ(pyramid.levels.size(), 2u);
    for (const PyramidLevel& level : pyramid.levels) {
        CoverGrid grid(pyramid.bounds, {0, 0, 1}, 4096);
        grid.add(level.positions,
                 std::span(pyramid.indices).subspan(level.primitives[0].first, level.primitives[0].count));
        EXPECT_NEAR(grid.area() / (2 * wireRadius * wireCount), 1, 0.01) << level.triangleCount << " triangles";
    }
}

}  // namespace
}  // namespace defocus::engine
