#pragma once
// Computes the directional albedo of glTF's specular reflection: the fraction of a uniform white environment that is
// reflected towards the eye.

#include <array>
#include <glm/vec2.hpp>

namespace defocus::engine {

// The albedo is F0·x + F90·y for a surface with reflectance F0 at normal incidence and F90 at grazing incidence.
// `table` holds (x, y) at `side` × `side` points; the point (column, row) is at n·v = (column / (side − 1))² and
// perceptual roughness row / (side − 1). Bilinear interpolation in √(n·v) and roughness differs from the exact integral
// by less than 1.5e-3 in 95 % of the domain, and by less than 6e-3 where n·v ≥ 0.02.
struct SpecularAlbedoTable {
    static constexpr int side = 32;
    std::array<glm::vec2, std::size_t{side} * side> table;
};

// Returns the table, which is computed on the first call. Its entries are integrals of the single-scattering GGX BRDF
// over all directions of incidence, with height-correlated Smith masking and Schlick's Fresnel (Walter et al. 2007;
// Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs).
const SpecularAlbedoTable& specularAlbedoTable();

// Returns the factors (x, y) of F0 and F90 in the albedo, by interpolation in the table. `cosine`: n·v, in [0, 1].
// `roughness`: perceptual roughness, in [0, 1].
glm::vec2 specularAlbedo(float cosine, float roughness);

}  // namespace defocus::engine
