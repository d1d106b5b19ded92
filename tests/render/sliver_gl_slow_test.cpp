// Tests that no sample of a very narrow triangle has a colour outside the range of the corners' colours. The triangles
// are far narrower than the subpixel precision of rasterizers.

#include <gtest/gtest.h>

#include "gl/context.h"
#include "gl_conduct.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

constexpr double sliverDepth = 2;   // m
constexpr double sliverTan = 0.36;  // tangent of half the horizontal field of view

class RandomUnits {
public:
    double operator()() {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state_ >> 11) * 0x1p-53;
    }

private:
    std::uint64_t state_ = 1;
};

// Returns triangles that are 1e-6 to 1 px wide, in random directions. The corners of each triangle are all dark or all
// bright.
Mesh slivers(int count, double pixel) {
    Mesh mesh;
    RandomUnits random;
    Primitive primitive{0, {}};
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 middle = 2.0 * sliverTan * sliverDepth * glm::dvec2(random() - 0.5, 0.75 * (random() - 0.5));
        const double angle = 2 * std::numbers::pi * random();
        const glm::dvec2 along(std::cos(angle), std::sin(angle));
        const glm::dvec2 across(-along.y, along.x);
        const double length = 30 * pixel * random();
        const double width = pixel * std::pow(10, -6 * random());
        const double depth = -sliverDepth - 0.1 * random();
        const int shade = i % 2 == 0 ? 20 : 200;
        for (const glm::dvec2& corner : {middle - length * along, middle + length * along, middle + width * across}) {
            primitive.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.count()));
            mesh.vertices.positions.emplace_back(corner.x, corner.y, depth);
            mesh.vertices.normals.emplace_back(0, 0, 1);
            mesh.vertices.colors.emplace_back(glm::vec3(shade + static_cast<int>(20 * random())) / 255.0f, 1);
        }
    }
    mesh.primitives.push_back(std::move(primitive));
    return mesh;
}

TEST(Sliver, noSampleHasAColorThatItsCornersDoNotAllow) {
    SKIP_ON_SECOND_DRIVER();
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    SmallWorld small;
    small.scene.materials.push_back(unlitMaterial({1, 1, 1, 1}));
    small.scene.materials[0].doubleSided = true;
    small.view.width = 128;
    small.view.height = 96;
    small.view.lens.dofEnabled = false;
    small.scene.meshes.push_back(slivers(100'000, 2 * sliverTan * sliverDepth / small.view.width));
    place(small, 0, glm::dmat4(1));
    small.world.pyramids.push_back(fullDetail(small.scene.meshes[0]));
    small.world.environment.type = EnvironmentType::none;

    const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
    const auto renderer = makeAccumulationRenderer(small.world, options);
    int covered = 0;
    for (std::uint32_t seed = 0; seed < 16; ++seed) {
        const RenderSettings settings{.sampleCount = 1, .seed = seed, .lod = LodMode::off};
        const Image image = imageOf(*renderer, planFrame(small.world, small.view, settings));
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                if (image.at(x, y)[3] == 0) continue;
                ++covered;
                const double value = 255 * static_cast<double>(image.at(x, y)[0]);
                EXPECT_TRUE((value > 19.99 && value < 40.01) || (value > 199.99 && value < 220.01))
                    << value << " at " << x << ", " << y;
            }
    }
    EXPECT_GT(covered, 10'000);
}

}  // namespace
}  // namespace defocus::engine
