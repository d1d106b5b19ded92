// Tests that a level shows each texel where level 0 shows it, to within the blur at which the level is drawn.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "lod/pyramid/blurred_error.h"
#include "lod/pyramid/finish.h"
#include "lod/pyramid/level_selection.h"
#include "lod/pyramid/picture.h"
#include "lod/shapes.h"
#include "models.h"
#include "scene/gltf/gltf.h"

namespace defocus::engine {
namespace {

// Returns a material appearance that shows a surface's texture coordinates, modulo 1, as red and green; blue is 1.
Finish showingCoordinates() {
    constexpr int side = FinishImage::maxSide;
    const auto ramp = std::make_shared<FinishImage>();
    ramp->width = ramp->height = side;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) ramp->texels.emplace_back(x, y, 255);
    Finish finish;
    finish.unlit = true;
    finish.baseColorMap.image = ramp;
    return finish;
}

// Returns the length in object units of one unit of the texture coordinates, averaged over the area of level 0.
double unitsPerCoordinate(const Pyramid& pyramid) {
    const PyramidLevel& level = pyramid.levels.front();
    double surface = 0;
    double texture = 0;
    for (std::size_t i = 0; i < std::size_t{3} * level.triangleCount; i += 3) {
        const std::uint32_t* const v = &pyramid.indices[i];
        surface += glm::length(glm::cross(glm::dvec3(level.positions[v[1]]) - glm::dvec3(level.positions[v[0]]),
                                          glm::dvec3(level.positions[v[2]]) - glm::dvec3(level.positions[v[0]])));
        const glm::dvec2 b = level.uv0[v[1]] - level.uv0[v[0]];
        const glm::dvec2 c = level.uv0[v[2]] - level.uv0[v[0]];
        texture += std::abs(b.x * c.y - b.y * c.x);
    }
    return std::sqrt(surface / texture);
}

struct Shift {
    double mean = 0;  // mean distance, in object units
    // fraction of pixels in which the two levels show different UV charts or different parts of the surface
    double elsewhere = 0;
};

// Returns how far a level's texture is shifted relative to level 0's texture. Compares the pixels that both levels
// cover, in the views that are used to measure errors under blur. If a pixel shows the same part of the surface in both
// levels, the shift is at most the level's longest edge. Pixels with a larger shift show different parts, for example
// beside a strap that became thinner. These pixels count as `elsewhere`.
Shift shiftOf(const Pyramid& pyramid, std::size_t number) {
    constexpr int resolution = 512;
    const std::vector<Finish> finishes(pyramid.levels.front().primitives.size(), showingCoordinates());
    const double scale = unitsPerCoordinate(pyramid);
    double sum = 0;
    double shifted = 0;
    double others = 0;
    for (const glm::dvec3& direction : blurredErrorViews()) {
        const Eye eye = eyeAlong(pyramid, direction, resolution);
        const Picture reference = pictureOf(pyramid, 0, eye, finishes);
        const Picture level = pictureOf(pyramid, number, eye, finishes);
        for (std::size_t i = 0; i < reference.light.size(); ++i) {
            if (reference.light[i].z == 0 || level.light[i].z == 0) continue;
            glm::dvec2 change = glm::dvec2(level.light[i]) - glm::dvec2(reference.light[i]);
            change -= glm::round(change);
            const double distance = scale * glm::length(change);
            if (distance > pyramid.levels[number].longestEdge) {
                ++others;
                continue;
            }
            sum += distance;
            ++shifted;
        }
    }
    return {sum / shifted, others / (others + shifted)};
}

// Returns the smallest blur width, in object units, at which at least half of `samples` samples draw the level, or
// nullopt if there is no such blur. Pixels are assumed to be as wide as the blur. With smaller pixels, edges would be
// longer in px, and a finer level would be selected.
std::optional<double> minPatch(const Pyramid& pyramid, std::size_t level, std::uint32_t samples) {
    const double light = defaultThresholds(LodMetric::measured, samples).light;
    const auto isDrawn = [&](double side) {
        return levelOfBlurredError(pyramid, std::vector{side}, 1 / side, light) >= static_cast<double>(level) - 0.5;
    };
    double large = pyramid.smallestPatch * std::exp2(double{blurSizes - 2});
    if (!isDrawn(large)) return {};
    double small = 0;
    for (int i = 0; i < 40; ++i) (isDrawn(0.5 * (small + large)) ? large : small) = 0.5 * (small + large);
    return large;
}

TEST(TextureShift, isMeasured) {
    Mesh mesh = flatGrid(16);
    mesh.vertices.uv0.clear();
    for (const glm::vec3& p : mesh.vertices.positions) mesh.vertices.uv0.emplace_back(0.1f + 0.5f * glm::vec2(p));
    Pyramid pyramid = fullDetail(mesh);
    pyramid.levels.push_back(pyramid.levels.front());
    EXPECT_NEAR(unitsPerCoordinate(pyramid), 2, 1e-4);
    EXPECT_LT(shiftOf(pyramid, 1).mean, 1e-6);
    for (glm::vec2& uv : pyramid.levels[1].uv0) uv.x += 0.01f;
    // the colour ramp has 256 texels, hence the factor 256/255
    EXPECT_NEAR(shiftOf(pyramid, 1).mean, 2 * 0.01 * 256 / 255, 1e-4);
    EXPECT_EQ(shiftOf(pyramid, 1).elsewhere, 0);
}

class TextureShiftOf : public testing::TestWithParam<const char*> {};

// A level's texture is shifted by less than the width of the smallest blur at which the level is drawn. Texture detail
// finer than the blur is invisible: one texel of the visible mip level is as wide as the blur.
TEST_P(TextureShiftOf, levelsIsBelowOneTexelOfTheBlur) {
    DEFOCUS_MODEL_OR_SKIP(path, GetParam());
    const Scene scene = loadGltf(path);
    const Finishes finishes(scene);
    std::size_t judged = 0;
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.vertices.uv0.empty()) continue;
        const Pyramid pyramid = buildPyramid(mesh, {.finishes = &finishes});
        for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
            const std::optional<double> patch = minPatch(pyramid, l, 16);
            if (!patch) break;
            const Shift shift = shiftOf(pyramid, l);
            EXPECT_LT(shift.mean, *patch) << mesh.name << ", level " << l;
            EXPECT_LT(shift.elsewhere, 0.5) << mesh.name << ", level " << l;
            RecordProperty(testNameOf(mesh.name + "_" + std::to_string(l)), std::to_string(shift.mean / *patch));
            ++judged;
        }
    }
    EXPECT_GE(judged, 2u);
}

INSTANTIATE_TEST_SUITE_P(Models, TextureShiftOf,
                         testing::Values("FlightHelmet/FlightHelmet.gltf", "WaterBottle.glb", "Suzanne.glb"),
                         [](const auto& model) { return testNameOf(model.param); });

}  // namespace
}  // namespace defocus::engine
