#pragma once
// Computes the fraction of a line's light that passes through a part of the line, like shaders/line/weights.glsl, for
// tests and tables. The line crosses the lens; its light is the light of a narrow sector of the lens.
//
// Lines through the lens centre are denser near the centre, so a part of a line is weighted by its distance from the
// centre. For a disk and p from −1 to 1, part [p₁, p₂] has the fraction κ(p₁, p₂) = (p₂|p₂| − p₁|p₁|)/2 (Tzeng et al.
// 2012, with p from −1/2 to 1/2 and a factor 2 instead of 1/2).

namespace defocus::engine {

// Distribution of light along a line, for p from −backward to 1.
struct LineLight {
    double backward = 1;             // length of the part with p < 0 relative to the part with p > 0
    double forwardShare = 0.5;       // fraction of the light with p > 0
    double sphericalAberration = 0;  // coefficient of spherical aberration (Lens::sphericalAberration)
    double obstruction = 0;          // obstructed fraction of the lens area
};

double lightBetween(const LineLight& light, double p1, double p2);

}  // namespace defocus::engine
