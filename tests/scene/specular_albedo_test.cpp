// Tests the tabulated directional albedo of GGX against an integral over all normals of the distribution.

#include "scene/specular_albedo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace defocus::engine {
namespace {

// Returns the height-correlated Smith masking-shadowing term. nv and nl are the cosines of the angles between the
// normal and the directions to the eye and to the light.
double masking(double nv, double nl, double alpha) {
    const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1 + alpha * alpha * (1 / (c * c) - 1)) - 1); };
    return 1 / (1 + lambda(nv) + lambda(nl));
}

// Returns the albedo for Fresnel reflectances F0 = f0 and F90 = 1. The albedo is the mean of F·G·(v·h) / ((n·v)·(n·h))
// over normals h with density D·(n·h) (Walter et al. 2007, equation 35).
double albedo(double nv, double roughness, double f0) {
    constexpr int heights = 4000;
    constexpr int azimuths = 200;
    const double alpha = roughness * roughness;
    const glm::dvec3 eye(std::sqrt(1 - nv * nv), 0, nv);
    double sum = 0;
    for (int i = 0; i < heights; ++i) {
        const double u = (i + 0.5) / heights;
        const double nh = 1 / std::sqrt(1 + alpha * alpha * u / (1 - u));
        const double sine = std::sqrt(1 - nh * nh);
        for (int k = 0; k < azimuths; ++k) {
            const double azimuth = std::numbers::pi * (k + 0.5) / azimuths;
            const glm::dvec3 half(sine * std::cos(azimuth), sine * std::sin(azimuth), nh);
            const double vh = glm::dot(eye, half);
            const double nl = 2 * vh * nh - nv;
            if (vh <= 0 || nl <= 0) continue;
            sum += (f0 + (1 - f0) * std::pow(1 - vh, 5)) * masking(nv, nl, alpha) * vh / (nv * nh);
        }
    }
    return sum / (heights * azimuths);
}

TEST(SpecularAlbedo, isTheIntegralOverAllNormals) {
    for (const float roughness : {0.1f, 0.3f, 0.5f, 0.75f, 1.0f})
        for (const double degrees : {0.0, 45.0, 70.0, 85.0})
            for (const double f0 : {0.04, 1.0}) {
                const double nv = std::cos(degrees * std::numbers::pi / 180);
                const glm::dvec2 table = specularAlbedo(static_cast<float>(nv), roughness);
                EXPECT_NEAR(f0 * table.x + table.y, albedo(nv, double{roughness}, f0), 2e-3)
                    << "roughness " << roughness << ", " << degrees << " degrees, F0 = " << f0;
            }
}

TEST(SpecularAlbedo, ofAMirrorIsSchlicksFresnel) {
    for (const float nv : {0.1f, 0.4f, 0.8f, 1.0f}) {
        const float schlick = std::pow(1 - nv, 5.0f);
        const glm::vec2 table = specularAlbedo(nv, 0);
        EXPECT_NEAR(table.x, 1 - schlick, 2e-3f) << nv;
        EXPECT_NEAR(table.y, schlick, 2e-3f) << nv;
    }
}

TEST(SpecularAlbedo, ofAFacingWhiteMetal) {
    // The expected value, computed by another renderer, is the radiance of white metal in a uniform environment of
    // radiance 0.7.
    EXPECT_NEAR(0.7f * (specularAlbedo(1, 0.4f).x + specularAlbedo(1, 0.4f).y), 0.677f, 1e-3f);
    EXPECT_NEAR(0.7f * (specularAlbedo(1, 1).x + specularAlbedo(1, 1).y), 0.215f, 1e-3f);
}

}  // namespace
}  // namespace defocus::engine
