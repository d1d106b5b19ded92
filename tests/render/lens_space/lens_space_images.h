#pragma once
// Helpers that make scenes for tests of both lens-space methods and render them.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "core/error.h"
#include "gl_conduct.h"
#include "gl_context_test.h"
#include "image/metrics.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {

inline RenderSettings raySettings(std::uint32_t samples) {
    // keepAll samples the lens even if nothing is visibly blurred, and disables culling
    return {.sampleCount = samples, .lod = LodMode::off, .keepAll = true};
}

inline Image lensSpaceImage(const char* method, const SmallWorld& small, std::uint32_t samples,
                            RenderStats* stats = nullptr, std::uint32_t wave = 0) {
    const MethodUse use = parseMethodUse(method);
    const RendererOptions options{.wave = wave, .settings = use.settings};
    const auto renderer = use.method->make(small.world, options);
    Image image = imageOf(*renderer, planFrame(small.world, small.view, raySettings(samples)));
    if (stats != nullptr) *stats = renderer->stats();
    return image;
}

inline double psnrAgainst(const Image& reference, const Image& image) {
    return compareImages(reference, image, CompareOptions{}).psnr;
}

// Returns two lit, rippled spheres under a gradient sky. One is in front of the focal plane and one behind it.
inline std::unique_ptr<SmallWorld> twoSpheres(int slices = 24, int stacks = 18) {
    auto small = std::make_unique<SmallWorld>();
    const Material glossy{.metallicFactor = 0, .roughnessFactor = 0.4f};
    small->scene.materials.push_back(glossy);
    small->scene.meshes.push_back(bumpySphere(slices, stacks, 0));
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {-0.2, -0.1, -1.4}), glm::dvec3(0.2)));
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {0.6, 0.4, -5}), glm::dvec3(-0.9, 0.9, 0.9)));
    addSun(*small);
    small->world.environment = gradientSky();
    small->view.lens.fStop = 1;
    small->view.lens.focusDistance = 2.2;
    small->view.width = 72;
    small->view.height = 56;
    finish(*small);
    return small;
}

inline double figureOf(const RenderStats& stats, const std::string& name) {
    for (const MethodFigure& figure : stats.figures)
        if (figure.name == name) return figure.value;
    return std::nan("");
}

// Returns a ground plane that extends from behind the camera into the distance, so that the near plane cuts it.
inline std::unique_ptr<SmallWorld> groundUnderCamera() {
    auto small = std::make_unique<SmallWorld>();
    Mesh mesh = quad(0);
    mesh.vertices.colors = {{1, 0.2f, 0.1f, 1}, {0.1f, 1, 0.2f, 1}, {0.2f, 0.1f, 1, 1}, {1, 1, 0.2f, 1}};
    small->scene.materials.push_back(unlitMaterial(glm::vec4(1)));
    small->scene.meshes.push_back(mesh);
    place(*small, 0,
          glm::rotate(glm::scale(glm::translate(glm::dmat4(1), {0.1, -0.3, 0}), glm::dvec3(4)), -0.5 * std::numbers::pi,
                      glm::dvec3(1, 0, 0)));
    small->world.environment = {EnvironmentType::uniform, {0.3f, 0.4f, 0.9f}, {}, {}, nullptr, 1};
    small->view.width = 64;
    small->view.height = 48;
    small->view.lens.fStop = 0.5;
    small->view.lens.focusDistance = 1.5;
    finish(*small);
    return small;
}

inline void expectRefusal(const char* method, const SmallWorld& small, const std::string& part) {
    try {
        lensSpaceImage(method, small, 4);
        FAIL() << method << " took it";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

class LensSpace : public GlContextTest, public testing::WithParamInterface<const char*> {
protected:
    void TearDown() override { EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR}); }
};

// Returns a grid that covers 6 × 6 px within one tile. It has side² squares of two triangles each.
inline std::unique_ptr<SmallWorld> gridInATile(std::uint32_t side) {
    auto small = std::make_unique<SmallWorld>();
    Mesh mesh;
    mesh.name = "grid";
    for (std::uint32_t y = 0; y <= side; ++y)
        for (std::uint32_t x = 0; x <= side; ++x)
            mesh.vertices.positions.emplace_back(static_cast<float>(x) / side, static_cast<float>(y) / side, 0);
    mesh.vertices.normals.assign(mesh.vertices.positions.size(), {0, 0, 1});
    Primitive primitive{0, {}};
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t i = y * (side + 1) + x;
            for (const std::uint32_t v : {i, i + 1, i + side + 2, i, i + side + 2, i + side + 1})
                primitive.indices.push_back(v);
        }
    mesh.primitives.push_back(primitive);
    small->scene.materials.push_back(unlitMaterial(glm::vec4(1)));
    small->scene.meshes.push_back(mesh);
    small->view.width = small->view.height = 32;
    small->view.lens.dofEnabled = false;
    const double pixel = 2 * tanHalfHorizontalFov(small->view.lens) * 2 / 32;  // size of a pixel in m at a depth of 2 m
    // The grid covers columns 17 to 22 from the left and rows 17 to 22 from the bottom, counted from 0. It lies inside
    // the tiles of 8 × 8 and of 16 × 16 px that begin at pixel 16.
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {pixel, pixel, -2}), glm::dvec3(6 * pixel)));
    small->world.environment.type = EnvironmentType::none;  // no environment, so that alpha is the coverage
    small->world.pyramids.push_back(fullDetail(small->scene.meshes[0]));
    return small;
}

// Number of squares per side of a grid that has more than 65,536 triangles, the max number of loop iterations in Mesa's
// software driver.
inline constexpr std::uint32_t longerThanLoops = 184;

class LensSpaceAlone : public GlContextTest {
protected:
    void SetUp() override { SKIP_ON_SECOND_DRIVER(); }
};

}  // namespace defocus::engine
