// Source: Ramamoorthi and Hanrahan 2001, An Efficient Representation for Irradiance Environment Maps.

#include "render/gpu_scene/environment_light.h"

#include <cmath>
#include <glm/common.hpp>
#include <numbers>

namespace defocus::engine {

namespace {

// Returns the irradiance coefficients of a gradient with radiance L(y) = h + (z − h)·max(y, 0) + (n − h)·max(−y, 0) in
// a direction with vertical component y. z, h and n are the radiances at zenith, horizon and nadir. In Legendre
// polynomials, max(y, 0) = 1/4 + y/2 + 5/16·P2(y) + …. Convolution with the clamped cosine over π scales bands 0, 1 and
// 2 by 1, 2/3 and 1/4.
std::array<glm::vec4, 9> gradientCoefficients(const Environment& environment) {
    const glm::vec3 up = environment.zenith - environment.horizon;
    const glm::vec3 down = environment.nadir - environment.horizon;
    std::array<glm::vec4, 9> result{};
    result[0] = glm::vec4(environment.horizon + (up + down) * (1.0f / 4 - 5.0f / 128), 0);
    result[1] = glm::vec4((up - down) / 3.0f, 0);
    result[2] = glm::vec4((up + down) * (15.0f / 128), 0);
    return result;
}

std::array<double, 9> harmonics(const glm::dvec3& d) {
    return {0.282095,
            0.488603 * d.y,
            0.488603 * d.z,
            0.488603 * d.x,
            1.092548 * d.x * d.y,
            1.092548 * d.y * d.z,
            0.315392 * (3 * d.z * d.z - 1),
            1.092548 * d.x * d.z,
            0.546274 * (d.x * d.x - d.y * d.y)};
}

// Normalization factors of the spherical harmonics 1, y, z, x, xy, yz, 3z² − 1, xz, x² − y², each multiplied by the
// clamped cosine's factor for its band (1, 2/3 or 1/4).
constexpr std::array<double, 9> factors = {0.282095,         0.488603 * 2 / 3, 0.488603 * 2 / 3,
                                           0.488603 * 2 / 3, 1.092548 / 4,     1.092548 / 4,
                                           0.315392 / 4,     1.092548 / 4,     0.546274 / 4};

std::array<glm::vec4, 9> mapCoefficients(const Image& map) {
    std::array<glm::dvec3, 9> sums{};
    for (int y = 0; y < map.height; ++y) {
        const double polar = std::numbers::pi * (y + 0.5) / map.height;
        const double solidAngle =
            std::sin(polar) * (std::numbers::pi / map.height) * (2 * std::numbers::pi / map.width);
        for (int x = 0; x < map.width; ++x) {
            const double azimuth = 2 * std::numbers::pi * ((x + 0.5) / map.width - 0.5);
            const glm::dvec3 direction(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                       -std::sin(polar) * std::cos(azimuth));
            const float* pixel = map.at(x, y);
            const glm::dvec3 radiance =
                map.channels >= 3 ? glm::dvec3(pixel[0], pixel[1], pixel[2]) : glm::dvec3(pixel[0]);
            const glm::dvec3 seen = glm::mix(radiance, glm::dvec3(0), glm::isnan(radiance));
            const std::array<double, 9> basis = harmonics(direction);
            for (std::size_t i = 0; i < 9; ++i) sums[i] += seen * (basis[i] * solidAngle);
        }
    }
    std::array<glm::vec4, 9> result{};
    for (std::size_t i = 0; i < 9; ++i) result[i] = glm::vec4(glm::vec3(sums[i] * factors[i]), 0);
    return result;
}

}  // namespace

std::array<glm::vec4, 9> diffuseCoefficients(const Environment& environment) {
    switch (environment.type) {
        case EnvironmentType::gradient:
            return gradientCoefficients(environment);
        case EnvironmentType::map:
            return mapCoefficients(*environment.map);
        default:
            return {};
    }
}

}  // namespace defocus::engine
