#include "scene/specular_albedo.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace defocus::engine {

namespace {

// Returns Smith's Λ for GGX slopes of width α and a direction whose cosine to the normal is `cosine`.
double smithLambda(double cosine, double alpha) {
    const double tangent2 = 1 / (cosine * cosine) - 1;
    return 0.5 * (std::sqrt(1 + alpha * alpha * tangent2) - 1);
}

// Integrates over the microfacet normals that are visible from the eye (Dupuy and Benyoub 2023, Sampling Visible GGX
// Normals with Spherical Caps). Normals are sampled in proportion to D·G₁·(v·h), so the integrand is only F·G₂/G₁.
// Substituting 1 − (1 − t)³ for the cap's height concentrates the steps at grazing normals, where masking changes fast.
// The azimuth covers half a turn because of symmetry.
glm::vec2 integrated(double cosine, double alpha) {
    constexpr int heights = 32;
    constexpr int azimuths = 16;
    const glm::dvec3 eye(std::sqrt(1 - cosine * cosine), 0, cosine);
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * eye.x, 0, eye.z));
    const double lambdaV = smithLambda(cosine, alpha);
    double base = 0;
    double grazing = 0;
    double weights = 0;
    for (int i = 0; i < heights; ++i) {
        const double rest = 1 - (i + 0.5) / heights;
        const double weight = rest * rest;
        weights += weight * azimuths;
        const double z = rest * rest * rest * (1 + stretched.z) - stretched.z;
        const double sine = std::sqrt(std::max(0.0, 1 - z * z));
        for (int k = 0; k < azimuths; ++k) {
            const double azimuth = std::numbers::pi * (k + 0.5) / azimuths;
            const glm::dvec3 cap = glm::dvec3(sine * std::cos(azimuth), sine * std::sin(azimuth), z) + stretched;
            const glm::dvec3 half = glm::normalize(glm::dvec3(alpha * cap.x, alpha * cap.y, std::max(cap.z, 1e-9)));
            const double vh = std::clamp(glm::dot(eye, half), 0.0, 1.0);
            const double toLight = 2 * vh * half.z - cosine;  // n·l for the reflected direction l
            if (toLight <= 0) continue;
            const double masking = (1 + lambdaV) / (1 + lambdaV + smithLambda(toLight, alpha));
            const double schlick = std::pow(1 - vh, 5);
            base += weight * masking * (1 - schlick);
            grazing += weight * masking * schlick;
        }
    }
    return {base / weights, grazing / weights};
}

SpecularAlbedoTable integratedTable() {
    constexpr int side = SpecularAlbedoTable::side;
    SpecularAlbedoTable result{};
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const double root = std::max(column / (side - 1.0), 1e-2);
            const double roughness = std::max(row / (side - 1.0), 1e-3);
            result.table[static_cast<std::size_t>(row * side + column)] =
                integrated(root * root, roughness * roughness);
        }
    return result;
}

}  // namespace

const SpecularAlbedoTable& specularAlbedoTable() {
    static const SpecularAlbedoTable table = integratedTable();
    return table;
}

glm::vec2 specularAlbedo(float cosine, float roughness) {
    constexpr int side = SpecularAlbedoTable::side;
    const glm::vec2 place =
        glm::clamp(glm::vec2(std::sqrt(std::max(cosine, 0.0f)), roughness), 0.0f, 1.0f) * float(side - 1);
    const glm::ivec2 cell = glm::min(glm::ivec2(place), glm::ivec2(side - 2));
    const glm::vec2 part = place - glm::vec2(cell);
    const auto* corner = &specularAlbedoTable().table[static_cast<std::size_t>(cell.y * side + cell.x)];
    return glm::mix(glm::mix(corner[0], corner[1], part.x), glm::mix(corner[side], corner[side + 1], part.x), part.y);
}

}  // namespace defocus::engine
