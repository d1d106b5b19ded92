#pragma once
// Share of a line's light that passes through a part of the line: shaders/line/weights.glsl, for tests and tables.
//
// Lines through the lens centre are denser near the centre, so a part of a line is weighted by its distance from the
// centre. For a disk and p from −1 to 1, a part has the share κ(p₁, p₂) = (p₂|p₂| − p₁|p₁|)/2 (Tzeng et al. 2012, with
// p from −1/2 to 1/2 and a factor 2 instead of 1/2).

namespace defocus::engine {

// Distribution of light over a line, for p from −backward to 1.
struct LineLight {
    double backward = 1;             // reach of the line behind the centre, relative to its reach ahead
    double forwardShare = 0.5;       // share of the light that passes ahead of the centre
    double sphericalAberration = 0;  // Lens::sphericalAberration
    double obstruction = 0;          // obstructed share of the lens area
};

double lightBetween(const LineLight& light, double p1, double p2);

}  // namespace defocus::engine
