// Tests that NaN in materials and environment maps affects only the pixels that the blurred NaN surface or texel
// covers.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "stability/board_scene.h"
#include "stability/stability.h"

namespace defocus::engine {

namespace {

constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

// Returns the number of wrong pixels around a small board whose radiance is NaN. All pixels must be finite; pixels
// outside the board's blur must not differ from the scene without the board.
double materialError() {
    View view = boardView();
    setBlur(view, 5, 12);
    const double reach = 6 + 4 + 1;  // half side in px of the affected area: blur radius + half board + pixel filter
    const std::vector<Board> list = {squareAt(view, 5, 8, glm::vec3(notANumber)),
                                     squareAt(view, 7, 400, {0.3f, 0.5f, 0.7f})};
    BoardScene spoiled(view, list);
    BoardScene intact(view, {list[1]});
    const Image image = rendered(spoiled);
    const Image reference = rendered(intact);
    double wrong = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const bool inside = std::abs(x + 0.5 - 48) < reach && std::abs(y + 0.5 - 32) < reach;
            const bool finite = std::isfinite(image.at(x, y)[0]);
            if (!finite || (!inside && image.at(x, y)[0] != reference.at(x, y)[0])) wrong += 1;
        }
    return wrong;
}

// ---- a texel of an environment map ----------------------------------------------------------------------------------

constexpr int mapWidth = 256;  // width of the environment map, texels

// Returns an environment map with the radiance 0.5 everywhere. If x ≥ 0, the texel in column `x` at the horizon is NaN
// instead.
Environment surroundings(int x) {
    const auto map = std::make_shared<Image>(mapWidth, mapWidth / 2, 3);
    std::fill(map->pixels.begin(), map->pixels.end(), 0.5f);
    if (x >= 0) std::fill_n(map->at(x, mapWidth / 4), 3, notANumber);
    return {EnvironmentType::map, {}, {}, {}, map, 1};
}

// Returns the number of wrong pixels of a blurred sky with a NaN texel: pixels with values outside [0, 0.5], and pixels
// outside the texel's blur that differ from the sky without NaN.
double skyTexelError(LayerFormat format) {
    constexpr double blur = 12;  // diameter of the blur, px
    View view = boardView();
    setBlur(view, infinite, blur);
    const double texel =
        2 * std::acos(-1.0) / mapWidth * view.width * view.lens.focalLength / view.lens.horizontalAperture;
    // The upper left corner of the NaN texel is at the image's centre. Texture filtering spreads the texel over its
    // neighbours.
    const double reach = 0.5 * blur + texel + 1;
    const auto picture = [&](int x) {
        BoardScene sky(view, {});
        sky.world.environment = surroundings(x);
        return rendered(sky, "accumulation", {.layerFormat = format, .shaderFolder = {}, .settings = {}});
    };
    const Image image = picture(mapWidth / 2);
    const Image reference = picture(-1);
    double wrong = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double distance = std::hypot(x + 0.5 - 48 - 0.5 * texel, y + 0.5 - 32 - 0.5 * texel);
            const float value = image.at(x, y)[0];
            wrong += !(value >= 0 && value <= 0.5f) || (distance > reach + texel && value != reference.at(x, y)[0]);
        }
    return wrong;
}

// Returns the max relative error of the radiance of a rough surface that is lit by a map with a NaN texel. Its light
// comes from the map's spherical harmonics and mip levels.
double lightTexelError(float metallic) {
    View view = boardView();
    BoardScene wall(view, {{3, {0, 0}, {10, 10}, glm::vec3(0.8f)}});
    wall.scene->materials[0].unlit = false;
    wall.scene->materials[0].metallicFactor = metallic;
    const auto picture = [&](int x) {
        wall.world.environment = surroundings(x);
        return rendered(wall);
    };
    const Image image = picture(0);  // the NaN texel is behind the camera and faces the wall
    const Image reference = picture(-1);
    double largest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double error = std::abs(static_cast<double>(image.at(x, y)[0]) / reference.at(x, y)[0] - 1);
            largest = std::isnan(error) ? infinite : std::max(largest, error);
        }
    return largest;
}

}  // namespace

void addValueCases(std::vector<StabilityCase>& cases) {
    const auto add = [&](std::string name, std::string measured, std::string reference, double limit,
                         std::function<double()> error) {
        cases.push_back(
            {"values", std::move(name), std::move(measured), std::move(reference), limit, std::move(error)});
    };
    add("a material with NaN radiance", "pixels spoiled elsewhere", "the scene without it", 0, materialError);
    const auto addSky = [&](const char* layers, LayerFormat format) {
        add(fmt::format("a NaN texel in a blurred sky, {} layers", layers), "pixels spoiled elsewhere",
            "the map without it", 0, [format] { return skyTexelError(format); });
    };
    addSky("half-float", LayerFormat::rgba16f);
    addSky("32-bit", LayerFormat::rgba32f);
    // NaN counts as black. The texel would contribute 2e-4 of the irradiance and 3e-5 of the smallest mip level, so its
    // absence causes an error below the limit of 1e-3.
    add("a map with a NaN texel lights rough metal", "radiance, relative", "the map without it", 1e-3,
        [] { return lightTexelError(1); });
    add("a map with a NaN texel lights a non-metal", "radiance, relative", "the map without it", 1e-3,
        [] { return lightTexelError(0); });
}

}  // namespace defocus::engine
