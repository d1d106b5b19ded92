// The map "overcast" is the CIE standard overcast sky (Moon and Spencer 1942): luminance L = Lz (1 + 2 sin h) / 3 at
// elevation h, where Lz is the luminance at the zenith.
#include "scene/built_in_environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "core/luminance.h"
#include "core/parallel.h"

namespace defocus::engine {

namespace {

constexpr int mapWidth = 512;
constexpr int mapHeight = 256;
constexpr int subsamples = 3;  // samples per pixel along each axis, to antialias the edges of softboxes

constexpr std::array<std::string_view, 3> names = {"studio", "overcast", "sunset"};

// Direction in radians: azimuth from +z (the front of glTF models) towards +x, and elevation above the horizon.
struct Heading {
    double azimuth = 0;
    double elevation = 0;
};

glm::dvec3 directionOf(const Heading& heading) {
    return {std::sin(heading.azimuth) * std::cos(heading.elevation), std::sin(heading.elevation),
            std::cos(heading.azimuth) * std::cos(heading.elevation)};
}

// Flat rectangular lamp that faces the origin. Half sizes are relative to the lamp's distance from the origin.
struct Softbox {
    Heading heading;
    double halfWidth;
    double halfHeight;
    glm::dvec3 radiance;
};

// Returns the lamp's radiance in a direction as a fraction of Softbox::radiance: highest at the centre, falling towards
// the rim, 0 outside the lamp.
double softboxShare(const Softbox& box, const glm::dvec3& direction) {
    const glm::dvec3 z = directionOf(box.heading);
    const double ahead = glm::dot(direction, z);
    if (ahead <= 0) return 0;
    const glm::dvec3 x =
        glm::normalize(glm::cross(std::abs(z.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1), z));
    const double across = std::abs(glm::dot(direction, x)) / (ahead * box.halfWidth);
    const double along = std::abs(glm::dot(direction, glm::cross(z, x))) / (ahead * box.halfHeight);
    if (across > 1 || along > 1) return 0;
    const double rim = glm::smoothstep(0.0, 0.12, 1 - std::max(across, along));
    return rim * (1 - 0.3 * std::min(across * across + along * along, 1.0));
}

glm::dvec3 studio(const glm::dvec3& d) {
    static const std::array<Softbox, 4> boxes = {{
        {{glm::radians(-18.0), glm::radians(38.0)}, 0.55, 0.42, {7.6, 7.2, 6.8}},  // key light
        {{glm::radians(95.0), glm::radians(14.0)}, 0.30, 0.75, {2.2, 2.35, 2.5}},  // fill light
        {{glm::radians(205.0), glm::radians(32.0)}, 0.22, 0.60, {7.5, 7.5, 7.5}},  // rim light
        {{0, glm::radians(90.0)}, 0.70, 0.40, {2.4, 2.4, 2.4}},                    // overhead light
    }};
    const double height = d.y;
    glm::dvec3 radiance = glm::mix(glm::dvec3(0.20, 0.21, 0.22), glm::dvec3(0.055), glm::smoothstep(-0.1, 0.9, height));
    if (height < 0) radiance = glm::mix(glm::dvec3(0.20, 0.21, 0.22), glm::dvec3(0.11), std::min(-2 * height, 1.0));
    for (const Softbox& box : boxes) radiance += softboxShare(box, d) * box.radiance;
    return radiance;
}

glm::dvec3 overcast(const glm::dvec3& d) {
    const glm::dvec3 ground(0.132, 0.128, 0.121);
    const double sky = (1 + 2 * std::max(d.y, 0.0)) / 3;
    return glm::mix(ground, sky * glm::dvec3(0.97, 1.0, 1.05), glm::smoothstep(-0.04, 0.02, d.y));
}

glm::dvec3 sunset(const glm::dvec3& d) {
    const glm::dvec3 sun = directionOf({glm::radians(-55.0), glm::radians(11.0)});
    const double toSun = std::acos(std::clamp(glm::dot(d, sun), -1.0, 1.0));
    const double up = std::max(d.y, 0.0);
    const double nearSun =
        0.5 + 0.5 * glm::dot(glm::normalize(glm::dvec3(d.x, 1e-9, d.z)), glm::normalize(glm::dvec3(sun.x, 0, sun.z)));
    const glm::dvec3 horizon = glm::mix(glm::dvec3(0.33, 0.27, 0.34), glm::dvec3(1.30, 0.55, 0.20), nearSun * nearSun);
    const glm::dvec3 zenith(0.13, 0.22, 0.42);
    const glm::dvec3 sky = glm::mix(horizon, zenith, 1 - std::exp(-3.2 * up));
    const glm::dvec3 ground(0.10, 0.075, 0.06);
    glm::dvec3 radiance = glm::mix(ground, sky, glm::smoothstep(-0.05, 0.02, d.y));
    radiance += glm::dvec3(1.0, 0.52, 0.20) * (1.1 * std::exp(-toSun / 0.22)) * glm::smoothstep(-0.05, 0.02, d.y);
    return radiance + glm::dvec3(1.0, 0.62, 0.30) * (260 * glm::smoothstep(0.052, 0.040, toSun));
}

glm::dvec3 radianceOf(std::size_t name, const glm::dvec3& direction) {
    return name == 0 ? studio(direction) : name == 1 ? overcast(direction) : sunset(direction);
}

}  // namespace

std::span<const std::string_view> builtInEnvironments() {
    return names;
}

bool isBuiltInEnvironment(const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

namespace {

// Returns the illuminance (lux) that the map gives an upward-facing horizontal surface.
double levelIlluminance(const Image& map) {
    double sum = 0;
    for (int y = 0; y < map.height / 2; ++y) {
        const double polar = std::numbers::pi * (y + 0.5) / map.height;
        const double solidAngle =
            std::sin(polar) * (std::numbers::pi / map.height) * (2 * std::numbers::pi / map.width);
        for (int x = 0; x < map.width; ++x) {
            sum += luminance(map.at(x, y)) * std::cos(polar) * solidAngle;
        }
    }
    return sum;
}

}  // namespace

Image builtInEnvironment(const std::string& name) {
    const auto which = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    Image map(mapWidth, mapHeight, 3);
    parallelFor(mapHeight, [&](std::size_t row) {
        for (int x = 0; x < mapWidth; ++x) {
            glm::dvec3 sum(0);
            for (int i = 0; i < subsamples * subsamples; ++i) {
                const double u = (x + (i % subsamples + 0.5) / subsamples) / mapWidth;
                const double v = (static_cast<double>(row) + (i / subsamples + 0.5) / subsamples) / mapHeight;
                // In the map, the centre column is the direction −z, and the right half has x > 0.
                const Heading heading{std::numbers::pi - 2 * std::numbers::pi * (u - 0.5),
                                      std::numbers::pi * (0.5 - v)};
                sum += radianceOf(which, directionOf(heading));
            }
            for (int c = 0; c < 3; ++c)
                map.at(x, static_cast<int>(row))[c] = static_cast<float>(sum[c] / (subsamples * subsamples));
        }
    });
    const auto scale = static_cast<float>(std::numbers::pi / levelIlluminance(map));
    for (float& value : map.pixels) value *= scale;
    return map;
}

Image turnedEnvironment(const Image& map, double angle) {
    Image turned(map.width, map.height, map.channels);
    const double columns = angle / (2 * std::numbers::pi) * map.width;
    const double whole = std::floor(columns);
    const auto share = static_cast<float>(columns - whole);
    const auto column = [&](int x) {
        const int shifted = static_cast<int>(std::fmod(x + whole, map.width));
        return shifted < 0 ? shifted + map.width : shifted;
    };
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            for (int c = 0; c < map.channels; ++c)
                turned.at(x, y)[c] = share == 0
                                         ? map.at(column(x), y)[c]
                                         : (1 - share) * map.at(column(x), y)[c] + share * map.at(column(x + 1), y)[c];
    return turned;
}

}  // namespace defocus::engine
