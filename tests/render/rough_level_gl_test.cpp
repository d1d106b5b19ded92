// Tests the shading of coarse levels of detail whose triangles have lost the relief that their normals still describe.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gl_context_test.h"
#include "lod/shapes.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

using RoughLevels = GlContextTest;

// Returns a square of side 2 with 12 × 12 hills. Slopes reach 27°, and the normals are those of the hills.
Mesh hills() {
    constexpr int cells = 96;
    constexpr double waves = 12;
    const double height = 0.5 / (std::numbers::pi * waves);
    const double rate = std::numbers::pi * waves;
    Mesh mesh = parametricSurface(cells, cells, [&](std::uint32_t i, std::uint32_t j) {
        const double x = 2.0 * i / cells - 1;
        const double y = 2.0 * j / cells - 1;
        return glm::dvec3(x, y, height * std::sin(rate * x) * std::sin(rate * y));
    });
    mesh.primitives[0].material = 0;
    for (std::size_t v = 0; v < mesh.vertices.count(); ++v) {
        const glm::dvec3 p = mesh.vertices.positions[v];
        mesh.vertices.normals[v] =
            glm::normalize(glm::dvec3(-height * rate * std::cos(rate * p.x) * std::sin(rate * p.y),
                                      -height * rate * std::sin(rate * p.x) * std::cos(rate * p.y), 1));
    }
    return mesh;
}

double meanLight(const SmallWorld& small, LodMode lod) {
    const RenderSettings settings{.sampleCount = 64, .lod = lod, .metric = LodMetric::size, .thresholds = {0.0, 40.0}};
    const Image image = imageInFloats(small.world, planFrame(small.world, small.view, settings));
    double sum = 0;
    double covered = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            sum += static_cast<double>(image.at(x, y)[0]);
            covered += static_cast<double>(image.at(x, y)[3]);
        }
    return sum / covered;
}

// A flat level of detail is as bright as the relief that it replaces. In an oblique view, hillsides that face the eye
// cover more of the image. Tilted by 55°, a flat level with only a mean normal would be too dark by 0.06, relative to a
// white surface that faces the sun.
TEST_F(RoughLevels, areAsBrightAsTheirRelief) {
    SmallWorld small;
    const Material matt{.metallicFactor = 0, .roughnessFactor = 1};
    small.scene.materials.push_back(matt);
    small.scene.meshes.push_back(hills());
    small.world.environment.type = EnvironmentType::none;
    small.view.width = 96;
    small.view.height = 96;
    small.view.lens.focalLength = 1200;
    small.view.lens.dofEnabled = false;
    finish(small);
    for (const double degrees : {0.0, 35.0, 55.0})
        for (const glm::dvec3& way : {glm::dvec3(0, 0, -1), {0.4, -0.3, -0.8}}) {
            small.world.pose.objects.clear();
            const glm::dmat4 away = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -100));
            place(small, 0, glm::rotate(away, glm::radians(degrees), glm::dvec3(0, 1, 0)));
            small.world.lights = {sunFrom(way, 1)};
            // The mean radiances are relative to the radiance of a white surface that faces the sun.
            const double reference = std::numbers::pi * meanLight(small, LodMode::off);
            EXPECT_NEAR(std::numbers::pi * meanLight(small, LodMode::nearest), reference, 0.02)
                << degrees << ' ' << way.x;
        }
}

}  // namespace
}  // namespace defocus::engine
