#pragma once
// Computes rays of a thin lens in camera space, derived from lens geometry instead of the rasteriser's clip-space
// equations.
//
// The rays of an image point (X, Y) ∈ [-1, 1]² (right, up) meet at a point P of the plane of focus at depth s,
//   P = s·(X·tan(θx/2), Y·tan(θy/2), -1)
// with the horizontal and vertical fields of view θx and θy. For a lens of diameter A, the ray from the lens point
// L = (A/2)·(u, v, 0) through P is
//   L + t·(X·tan(θx/2) − L.x/s, Y·tan(θy/2) − L.y/s, −1)
// Thus t is the depth in metres, and a lens focused at infinity (1/s = 0) needs no special case.
//
// A limit c₀ on the blur in front of the plane of focus (px, in an image W px wide) replaces the lens of radius A/2 at
// the eye. Each pixel has a separate lens on its own axis instead, at depth α, that images the eye onto the plane of
// focus. Rays leave the eye as through a pinhole, inside a cone around the axis that covers c₀ px. Objects between the
// eye and this lens are therefore blurred by c₀ px at any depth. Behind this lens, the blur must equal that of the
// original lens. This determines α: the original bundle of rays is as wide there as the cone,
//   2·(A/2)·(1/α − 1/s)·W/(2 tan(θx/2)) = c₀
// With object distance α and image distance s − α, the thin lens has
//   1/f = 1/α + 1/(s − α) = s/(α(s − α))
// (Munkberg, Toth and Akenine-Möller 2012, who print f instead of 1/f). A ray that meets the lens at distance h from
// its centre is bent by −h/f; see eyeRay and refractedRay.
//
// Sampling: Owen-scrambled (0, 2)-sequences (sample_scramble.h), one pair of dimensions for the lens and one for the
// pixel. packet_samples.h implements the same sampling for packets of rays.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "plan/view.h"

namespace defocus::engine {

struct LensCamera {
    double tanHalfHorizontal = 0;
    double tanHalfVertical = 0;
    double lensRadius = 0;       // lens radius in m; 0: pinhole
    double reciprocalFocus = 0;  // inverse focus distance in 1/m; 0: focus at infinity

    // Used only if the blur in the foreground is limited; see the description of the limit above.
    double lensDepth = 0;  // depth α of each pixel's own lens, m; 0: no limit, so all pixels share the lens at the eye
    double cone = 0;       // tangent of half the angle of the cone of rays that leave the eye for a pixel
};

LensCamera lensCamera(const View& view);

struct LensRay {
    glm::vec3 origin{0.0f};     // point on the eye's or the pixel's lens, in camera space
    glm::vec3 direction{0.0f};  // direction with z = −1: the ray parameter is the depth beyond the origin in m
};

// Returns the ray from lens point `lens` (unit disk) for image point `image` ([-1, 1]², right and up).
LensRay lensRay(const LensCamera& camera, const glm::dvec2& image, const glm::dvec2& lens);

// Functions for cameras that limit the blur in the foreground: each pixel has its own lens, at depth lensDepth. eyeRay
// returns the ray from the eye to this lens. refractedRay returns the ray's continuation behind it.
LensRay eyeRay(const LensCamera& camera, const glm::dvec2& image, const glm::dvec2& lens);
LensRay refractedRay(const LensCamera& camera, const glm::dvec2& image, const LensRay& eye);

// Selects a pair of sample dimensions: for the point on the lens, or for the point in the pixel.
enum class SamplePair : std::uint32_t { lens, pixel };

// Returns the point with number `index` of a scrambled Sobol' sequence in [0, 1)². `stream` selects the scramble: a
// different value for each pixel, or one value that all pixels share.
glm::dvec2 scrambledPoint(std::uint32_t index, std::uint32_t stream, SamplePair pair, std::uint32_t seed);

// Maps (r, s) ∈ [0, 1)² uniformly to the aperture: the unit disk, or the inscribed polygon with its first corner at the
// angle bladeRotation. An anamorphic ratio > 1 narrows it horizontally, < 1 vertically. Curved blades, rings,
// aberration and aperture images need ApertureMask instead.
glm::dvec2 aperturePoint(const Lens& lens, const glm::dvec2& square);

}  // namespace defocus::engine
