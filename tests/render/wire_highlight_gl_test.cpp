// Tests the highlight of a thin metal ring. Within a pixel, the normals vary by 180° across the wire, but hardly along
// it.

#include <gtest/gtest.h>

#include "gl_context_test.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

using WireHighlight = GlContextTest;

// Returns a torus around the z axis with a radius of 1 and a tube radius of 0.04, like a ring of wire.
Mesh ringMesh() {
    constexpr int around = 120;
    constexpr int across = 16;
    Mesh mesh;
    Primitive primitive{0, {}};
    const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(i % around * across + j % across); };
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            const double u = 2 * std::numbers::pi * i / around;
            const double v = 2 * std::numbers::pi * j / across;
            const glm::dvec3 outwards(std::cos(u), std::sin(u), 0);
            const glm::dvec3 normal = std::cos(v) * outwards + std::sin(v) * glm::dvec3(0, 0, 1);
            mesh.vertices.positions.emplace_back(outwards + 0.04 * normal);
            mesh.vertices.normals.emplace_back(normal);
            primitive.indices.insert(primitive.indices.end(), {index(i, j), index(i + 1, j), index(i + 1, j + 1),
                                                               index(i, j), index(i + 1, j + 1), index(i, j + 1)});
        }
    mesh.primitives.push_back(std::move(primitive));
    return mesh;
}

// Returns a golden ring about 40 px across, whose wire is 1.6 px thick, lit by a sun from the left.
std::unique_ptr<SmallWorld> ring() {
    auto small = std::make_unique<SmallWorld>();
    const Material gold{.baseColorFactor = {1, 0.77f, 0.34f, 1}, .roughnessFactor = 0.25f};
    small->scene.materials.push_back(gold);
    small->scene.meshes.push_back(ringMesh());
    place(*small, 0, glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -4.5)));
    small->world.lights = {sunFrom({1, -0.3, -0.2}, 3)};
    small->world.environment.type = EnvironmentType::none;
    small->view.width = small->view.height = 64;
    small->view.lens.dofEnabled = false;
    small->world.pyramids = {fullDetail(small->scene.meshes[0])};
    return small;
}

// Returns the sums of the red channel over the right, top, left and bottom quarters of the ring. The renderer widens
// highlights only in the first samples of a frame, so images without widened highlights begin with sample 2²⁰.
glm::dvec4 lightOfQuarters(const SmallWorld& small, std::uint32_t samples, bool widened) {
    const RenderSettings settings{
        .sampleCount = samples, .firstSample = widened ? 0 : 1u << 20, .lod = LodMode::off, .keepAll = true};
    const Image image = imageInFloats(small.world, planFrame(small.world, small.view, settings));
    glm::dvec4 sums(0);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double right = x + 0.5 - 0.5 * image.width;
            const double up = 0.5 * image.height - y - 0.5;
            const int quarter = std::abs(right) > std::abs(up) ? (right > 0 ? 0 : 2) : (up > 0 ? 1 : 3);
            sums[quarter] += double{image.at(x, y)[0]};
        }
    return sums;
}

TEST_F(WireHighlight, isNotSpreadAlongTheWire) {
    const auto small = ring();
    const glm::dvec4 truth = lightOfQuarters(*small, 256, false);
    const double total = truth.x + truth.y + truth.z + truth.w;
    for (const std::uint32_t samples : {16u, 64u}) {
        const glm::dvec4 light = lightOfQuarters(*small, samples, true);
        EXPECT_NEAR(light.y, truth.y, 0.02 * total) << "top, " << samples << " samples";
        EXPECT_NEAR(light.w, truth.w, 0.02 * total) << "bottom, " << samples << " samples";
        EXPECT_NEAR(light.x + light.y + light.z + light.w, total, 0.08 * total) << samples << " samples";
    }
}

}  // namespace
}  // namespace defocus::engine
