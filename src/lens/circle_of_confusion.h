#pragma once
// Computes the circle of confusion (CoC) at a clip-space position, including artistic controls.
// shaders/include/lens.glsl implements the same function. This version is used for culling, for planning frames, for
// choosing levels of detail, and in tests.
//
// In clip space the image of a point moves by C·(u, k·v) for a lens point (u, v) of the unit disk. C is the clip-space
// blur. The image has W × H px, and k = W/H. The thin lens has C(w) = a + b·w at depth w, with a = −(A/2)/tan(θx/2) and
// b = −a/s. A is the aperture's diameter and s the focus distance, both in m; θx is the horizontal field of view.
// Source: Munkberg, Toth and Akenine-Möller 2012, Per-Vertex Defocus Blur for Stochastic Rasterization. C has the
// opposite sign here: C > 0 behind the focus plane. The signed CoC diameter is c = C/w·W px. With artistic controls, it
// also depends on the image position n = (x/w, y/w) in normalised device coordinates. κ is the field curvature, t the
// tilt of the focus plane, and g the radial blur gain:
//   focus term    q = 1 + κ·r² + t·n,   r² = n.x² + (n.y/k)²      (the focus surface lies at w = s/q)
//   in front      F = a/w + b₁·q,       b₁ = −a/(s − focusRangeFront)
//   behind        B = a₂/w + b₂·q,      a₂ = a·(1 + focusRangeBehind/s), b₂ = −a/s
//     with Lens::focusRangeRefocuses:   a₂ = a,                          b₂ = −a/(s + focusRangeBehind)
//   diameter      c/W = clamp(factor·(1 + g·r²)·(min(0, F) + max(0, B)) + added, −R₁, R₂)
// Everything within the focus range is sharp. C keeps the thin lens's limits at both ends of the depth range: a at w =
// 0 and b·w for w → ∞. The focus range thus preserves strong near and far blur, and distant lights keep their disk
// size. With Lens::focusRangeRefocuses, the blur behind the range is that of a lens focused at the range's far end,
// which is smaller; the blur in front of the range stays the same. R₁ and R₂ are the blur limits in front and behind,
// as fractions of the image's width. `factor` and `added` are properties of the surface: factor 0 disables the lens's
// blur, and `added` is a fraction of the image's width.

#include <glm/vec2.hpp>
#include <limits>

#include "lens/lens.h"
#include "scene/mesh.h"

namespace defocus::engine {

struct ClipCircleOfConfusion {
    // At depth w, the blur is F = a/w + b₁·q in front of the focus plane, and B = a₂/w + b₂·q behind it (see above).
    double a = 0;        // a of F = a/w + b₁·q, the blur in front of the focus plane; ≤ 0
    double aBehind = 0;  // a₂ of B = a₂/w + b₂·q, the blur behind the focus plane; ≤ a
    double front = 0;    // b₁ of F = a/w + b₁·q, the blur in front of the focus plane
    double behind = 0;   // b₂ of B = a₂/w + b₂·q, the blur behind the focus plane; ≤ b₁
    // The focus term q = 1 + κ·r² + t·n is the focus distance divided by the depth of the focus surface. It varies over
    // the image if the surface is tilted (t) or curved (κ). n is the image position, and r its distance from the centre
    // (1 at the left and right edges).
    glm::dvec2 tilt{0};    // tilt t of the focus plane: gradient of the focus term q in normalised device coordinates
    double curvature = 0;  // field curvature κ: added to the focus term q at the left and right edges of the image
    double gain = 0;       // radial blur gain g: the blur is multiplied by 1 + g·r²
    // R₁ and R₂: max CoC in front of and behind the focus plane, as fractions of the image's width.
    double foregroundLimit = std::numeric_limits<double>::infinity();
    double backgroundLimit = std::numeric_limits<double>::infinity();
    double aspect = 1;  // aspect ratio k: image width / height
    // Factor that converts blur stored per vertex (glTF attribute _COC_OFFSET), in mm on the sensor, to a fraction of
    // the image's width. Includes Lens::blurScale; 0 for a pinhole.
    double shareOfMillimetre = 0;
    double astigmatism = 0;  // coefficient A of astigmatism in aberrations.h
    double coma = 0;         // coefficient B of coma in aberrations.h
    double chromatic = 0;    // max change of `front` and `behind` by axial chromatic aberration, over all wavelengths

    // Returns true if the lens has a range of sharp depths. The formulas for the blur in front of the range and behind
    // it (F and B above) then have different coefficients.
    [[nodiscard]] bool hasFocusRange() const { return front != behind || a != aBehind; }
    // Returns true if the lens has neither artistic controls nor aberrations, except axial chromatic aberration. The
    // clip-space blur (CoC · depth) of such a lens is a linear function of the depth w: a + front·w.
    [[nodiscard]] bool thinLens() const;
    // Returns true if the blur of a point depends on its position in the image, not only on its depth.
    [[nodiscard]] bool varies() const;
    // Returns true if astigmatism or coma blurs even points in focus.
    [[nodiscard]] bool aberrates() const { return astigmatism != 0 || coma != 0; }
};

// Returns the coefficients of the circle of confusion for a lens and an image of `width` x `height` px.
ClipCircleOfConfusion clipCircleOfConfusion(const Lens& lens, int width, int height);

// Returns the signed CoC diameter in px at depth `z` (m, > 0; infinity is allowed); > 0 behind the focus plane. `width`
// is the image's width in px, and `ndc` is the position in the image. `factor` and `added` are the surface's blur
// modifiers; `added` is a fraction of the image's width.
double circleOfConfusion(const ClipCircleOfConfusion& coc, double z, int width, const glm::dvec2& ndc = glm::dvec2(0),
                         double factor = 1, double added = 0);

// Range of the signed CoC diameter over a bounding box. Aberrations displace rays as defocus does, so they widen the
// range at both ends.
struct CocRange {
    double nearest = 0;   // min signed CoC, px: at the nearest depth
    double farthest = 0;  // max signed CoC, px: at the farthest depth
    double smallest = 0;  // min |CoC|, px; 0 if a point in the box may be in focus
    double largest = 0;   // max |CoC|, px
};

// Bounds of the blur modifiers of surfaces: a factor that multiplies the lens's blur, and a blur that is added to it.
// The added blur is a fraction of the image's width.
struct OwnBlur {
    double factorMin = 1;
    double factorMax = 1;
    double addedMin = 0;
    double addedMax = 0;
    [[nodiscard]] bool varies() const { return factorMin != factorMax || addedMin != addedMax; }
    [[nodiscard]] bool none() const { return !varies() && factorMin == 1 && addedMin == 0; }
};

// Returns bounds on how an object modifies the lens's blur, for the object's factor `factor` ≥ 0 and the bounds
// `vertices` of its vertices' modifiers.
OwnBlur ownBlur(const ClipCircleOfConfusion& coc, double factor, const VertexBlurBounds& vertices);

// Depths and image positions of a box's content. Depths are [zNear, zFar] in m with 0 < zNear ≤ zFar; infinity is
// allowed. Image positions are [ndcMin, ndcMax]. `own` bounds the blur modifiers of the surfaces in the box.
struct CocBox {
    double zNear = 0;
    double zFar = 0;
    glm::dvec2 ndcMin{0};
    glm::dvec2 ndcMax{0};
    OwnBlur own{};
};

// Returns bounds of the CoC over the box by interval arithmetic. The bounds are exact for the thin lens and
// conservative otherwise. They change continuously with the box.
CocRange circleOfConfusionRange(const ClipCircleOfConfusion& coc, const CocBox& box, int width);

// Returns the coefficients of the CoC of a thin lens that `coc` describes, after the lens is refocused at
// `focusDistance` (m; infinity is allowed).
ClipCircleOfConfusion refocused(const ClipCircleOfConfusion& coc, double focusDistance);

// Returns the largest |CoC| in px at infinite depth, over all positions in the image.
double largestCocAtInfinity(const ClipCircleOfConfusion& coc, int width);

// Upper bounds, in px, on the CoC error if the clip-space blur, CoC · depth, is interpolated linearly inside a
// triangle.
struct CocDeviation {
    // Max error at kinks, depths at which the slope of the clip-space blur jumps. Splitting triangles there removes
    // this error.
    double kinks = 0;
    // Max error where the clip-space blur is not linear inside a triangle, for example because blur modifiers differ
    // between its vertices. Only smaller triangles reduce this error.
    double curved = 0;
};

CocDeviation cocDeviation(const ClipCircleOfConfusion& coc, const CocBox& box, double longestEdge,
                          const glm::dvec2& tanHalf, int width);

}  // namespace defocus::engine
