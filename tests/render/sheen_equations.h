#pragma once
// Evaluates the equations of KHR_materials_sheen in double precision.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace defocus::engine {

// Returns the function Lambda of Estevez and Kulla 2017, as written in the specification of KHR_materials_sheen.
inline double sheenLambda(double cosine, double alpha) {
    const auto l = [&](double x) {
        const double t = (1 - alpha) * (1 - alpha);
        const auto between = [&](double rough, double smooth) { return rough + (smooth - rough) * t; };
        const double a = between(21.5473, 25.3245), b = between(3.82987, 3.32435), c = between(0.19823, 0.16801);
        const double d = between(-1.97760, -1.27393), e = between(-4.32054, -4.85967);
        return a / (1 + b * std::pow(x, c)) + d * x + e;
    };
    return cosine < 0.5 ? std::exp(l(cosine)) : std::exp(2 * l(0.5) - l(1 - cosine));
}

// Returns the sheen BRDF's factors D·V for the cosines from the normal to the light, the eye and the half vector.
// `roughness` is perceptual.
inline double sheenOf(double nl, double nv, double nh, double roughness) {
    const double alpha = roughness * roughness;
    const double sine = std::sqrt(std::max(1 - nh * nh, 0.0));
    const double distribution = (2 + 1 / alpha) * std::pow(sine, 1 / alpha) / (2 * std::numbers::pi);
    const double visibility = 1 / ((1 + sheenLambda(nv, alpha) + sheenLambda(nl, alpha)) * 4 * nv * nl);
    return distribution * std::min(visibility, 1.0);
}

}  // namespace defocus::engine
