#pragma once
// Fixture for shadows of straight edges under a disk-shaped sun: scenes, images, and the expected penumbra.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "gl/context.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {

class Shadowed : public testing::Test {
protected:
    static constexpr double receiverDepth = 4;  // distance in front of the camera, m
    static constexpr double tanHalfWidth = 36.0 / (2 * 50);

    static Material matt() { return {.metallicFactor = 0, .doubleSided = true, .specularFactor = 0}; }

    // Returns a scene without lights, in which a white wall fills the image of a pinhole camera at the origin.
    static std::unique_ptr<SmallWorld> wall() {
        auto small = std::make_unique<SmallWorld>();
        small->scene.materials.push_back(matt());
        small->scene.meshes.push_back(quad(0));
        place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {0, 0, -receiverDepth}), glm::dvec3(3)));
        small->world.environment = {EnvironmentType::uniform, {}, {}, {}, nullptr, 1};
        small->view.width = 96;
        small->view.height = 72;
        small->view.lens.dofEnabled = false;
        return small;
    }

    static void addSun(SmallWorld& small, const glm::dvec3& toLight, double diameter) {
        PlacedLight sun = sunFrom(-toLight, 1);
        sun.light.angularDiameter = static_cast<float>(diameter);
        small.world.lights.push_back(sun);
    }

    // Adds a board 4 m wide, parallel to the wall and `height` m in front of it. Its left edge is at x = `left`.
    static void addEdge(SmallWorld& small, double left, double height) {
        place(small, 0,
              glm::scale(glm::translate(glm::dmat4(1), {left + 2, 0, height - receiverDepth}), glm::dvec3(2, 6, 1)));
    }

    static RenderSettings settingsFor(std::uint32_t samples, Shadows shadows) {
        return {.sampleCount = samples, .lod = LodMode::off, .shadows = shadows};
    }

    static Image shadowImage(const SmallWorld& small, const RenderSettings& settings,
                             const std::string& method = "accumulation", std::uint32_t wave = 0) {
        RendererOptions options{.layerFormat = LayerFormat::rgba32f, .wave = wave};
        const MethodUse use = parseMethodUse(method);
        options.settings = use.settings;
        const auto renderer = use.method->make(small.world, options);
        return imageOf(*renderer, planFrame(small.world, small.view, settings));
    }

    // Returns the x coordinate in m of the wall point at the centre of a column.
    static double wallX(const View& view, int column) {
        return (2 * (column + 0.5) / view.width - 1) * tanHalfWidth * receiverDepth;
    }

    // Returns the radiance of each column in the image's middle row, relative to the radiance without shadows.
    static std::vector<double> litShares(const SmallWorld& small, const RenderSettings& settings,
                                         const std::string& method = "accumulation") {
        RenderSettings without = settings;
        without.shadows = Shadows::off;
        const Image shadowed = shadowImage(small, settings, method);
        const Image lit = shadowImage(small, without, method);
        std::vector<double> shares;
        for (int x = 0; x < shadowed.width; ++x)
            shares.push_back(static_cast<double>(shadowed.at(x, shadowed.height / 2)[0]) /
                             lit.at(x, lit.height / 2)[0]);
        return shares;
    }

    // Returns the fraction of the unit disk left of x = a.
    static double diskShare(double a) {
        a = std::clamp(a, -1.0, 1.0);
        return 0.5 + (a * std::sqrt(1 - a * a) + std::asin(a)) / std::numbers::pi;
    }

    // Returns the fraction of the sun's disk that is visible from the position x on the wall. The board's left edge is
    // at x = `left`, at the distance d in front of the wall. The sun stands 45° to the right, and t is the tangent of
    // its angular radius. A point of the sun at a·t from the disk's centre casts the edge's shadow to left − d·(1 +
    // t·a)/(1 − t·a).
    static double litShareBehindEdge(double x, double left, double d, double t) {
        const double q = (left - x) / d;
        return diskShare((q - 1) / ((q + 1) * t));
    }

    std::unique_ptr<GlContext> context = createHeadlessContext();
};

}  // namespace defocus::engine
