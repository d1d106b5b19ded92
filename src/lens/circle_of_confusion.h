#pragma once
// The circle of confusion (CoC) as a function of the clip position, with an artist's controls: the same function as in
// shaders/include/lens.glsl, for level selection, culling, plans and tests.
//
// In clip space the image of a point moves by C·(u, k·v) for a lens point (u, v) of the unit disk, k = W/H. The thin
// lens has C(w) = a + b·w with a = −(A/2)/tan(θx/2) and b = −a/s (A the aperture's diameter, s the focus distance, m).
// This is Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization, with the
// opposite sign of C: here C > 0 behind the focus plane. The signed diameter is c = C/w·W px, a function of 1/w and of
// the place n = (x/w, y/w) in the image, in normalised device coordinates:
//   focus term    q = 1 + κ·r² + t·n,   r² = n.x² + (n.y/k)²      (curved focus surface, tilted focus plane)
//   in front      F = a/w + b₁·q,       b₁ = −a/(s − focusRangeFront)
//   behind        B = a₂/w + b₂·q,      a₂ = a·(1 + focusRangeBehind/s), b₂ = −a/s
//                 refocused:            a₂ = a,                          b₂ = −a/(s + focusRangeBehind)
//   c/W = clamp(factor·(1 + g·r²)·(min(0, F) + max(0, B)) + added, −R₁, R₂)
// Between the two ends of the focus range everything is sharp. In C, which is linear in w, its range keeps what the
// thin lens has at the two ends of all depths: a right before the lens, w = 0, and b·w far away. So the range preserves
// near and far blur, and lights in the distance keep their disks. Refocused, the blur behind is that of a lens which is
// focused at the range's far end, and smaller; in front, the two forms are one. R₁, R₂ are the limits of the blur in
// front and behind, as shares of the image's width. A surface has a factor (0 switches the lens's blur off) and may add
// a blur of its own.

#include <glm/vec2.hpp>
#include <limits>

#include "lens/lens.h"
#include "scene/mesh.h"

namespace defocus::engine {

struct ClipCircleOfConfusion {
    double a = 0;
    double aBehind = 0;                                                // a₂ ≤ a
    double front = 0;                                                  // b₁
    double behind = 0;                                                 // b₂ ≤ b₁
    glm::dvec2 tilt{0};                                                // t
    double curvature = 0;                                              // κ
    double gain = 0;                                                   // g
    double foregroundLimit = std::numeric_limits<double>::infinity();  // R₁
    double backgroundLimit = std::numeric_limits<double>::infinity();  // R₂
    double aspect = 1;                                                 // k
    double shareOfMillimetre = 0;  // of the image's width, of blur that vertices have in mm on the sensor
    double astigmatism = 0;        // A of aberrations.h
    double coma = 0;               // B of aberrations.h
    double chromatic = 0;          // the most that a wavelength adds to b₁ and b₂ or takes from them

    // F and B differ.
    [[nodiscard]] bool hasFocusRange() const { return front != behind || a != aBehind; }
    // C = a + b·w everywhere, and nothing else moves what the lens shows: none of the controls is in use.
    [[nodiscard]] bool thinLens() const;
    // What the lens does depends on the place in the image.
    [[nodiscard]] bool varies() const;
    // Points in focus aren't points.
    [[nodiscard]] bool aberrates() const { return astigmatism != 0 || coma != 0; }
};

// Of an image of `width` x `height` px.
ClipCircleOfConfusion clipCircleOfConfusion(const Lens& lens, int width, int height);

// Signed CoC diameter in px at depth `z` (m, > 0; infinity is allowed) of an image `width` px wide, at the place `ndc`,
// of a surface with a factor and what it adds, a share of the image's width; > 0 behind the focus plane.
double circleOfConfusion(const ClipCircleOfConfusion& coc, double z, int width, const glm::dvec2& ndc = glm::dvec2(0),
                         double factor = 1, double added = 0);

// Aberrations move what lens points show as blur would do, so they widen the range to both sides.
struct CocRange {
    double nearest = 0;   // least signed CoC, px: that of the nearest depth
    double farthest = 0;  // greatest signed CoC, px: that of the farthest depth
    double smallest = 0;  // least |CoC|, px; 0 when it straddles what is in focus
    double largest = 0;   // greatest |CoC|, px
};

// What surfaces make of the lens's blur: bounds of their factor and of what they add, as a share of the image's width.
struct OwnBlur {
    double factorMin = 1;
    double factorMax = 1;
    double addedMin = 0;
    double addedMax = 0;
    [[nodiscard]] bool varies() const { return factorMin != factorMax || addedMin != addedMax; }
    [[nodiscard]] bool none() const { return !varies() && factorMin == 1 && addedMin == 0; }
};

// Of an object whose blur is scaled by `factor` ≥ 0 and whose vertices have a blur of their own within `vertices`.
OwnBlur ownBlur(const ClipCircleOfConfusion& coc, double factor, const VertexBlurBounds& vertices);

// What a box shows of itself: depths [zNear, zFar], 0 < zNear ≤ zFar (infinity is allowed), places [ndcLeast, ndcMost]
// and what its surfaces make of the blur.
struct CocBox {
    double zNear = 0;
    double zFar = 0;
    glm::dvec2 ndcMin{0};
    glm::dvec2 ndcMax{0};
    OwnBlur own{};
};

// Bounds of the CoC over all of the box, by interval arithmetic: exact for the thin lens, otherwise on the safe side.
// They move continuously with the box.
CocRange circleOfConfusionRange(const ClipCircleOfConfusion& coc, const CocBox& box, int width);

// The largest |CoC| of what lies infinitely far behind the image's pixels, px.
double largestCocAtInfinity(const ClipCircleOfConfusion& coc, int width);

// Bounds, in px, how far C can be from its linear interpolation inside a triangle in the box whose edges are at most
// `longestEdge` m long; `tanHalf` is (tan(θx/2), tan(θy/2)).
struct CocDeviation {
    double kinks = 0;   // where C is made of several linear pieces; triangles can be split there
    double curved = 0;  // of the curved forms, and of blur that vertices have themselves; triangles must be small
};

CocDeviation cocDeviation(const ClipCircleOfConfusion& coc, const CocBox& box, double longestEdge,
                          const glm::dvec2& tanHalf, int width);

}  // namespace defocus::engine
