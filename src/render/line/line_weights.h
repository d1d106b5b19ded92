#pragma once
// What share of a line's light passes through a part of it: as shaders/line/weights.glsl, for tests and tables.
//
// Lines through the centre of the lens lie close to each other there, so that a part of a line counts with its distance
// from the centre. For a disk and p from −1 to 1 a part has κ(p₁, p₂) = (p₂|p₂| − p₁|p₁|)/2 of the light (Tzeng et al.
// 2012, whose p goes from −1/2 to 1/2, with 2 instead of 1/2).

namespace defocus::engine {

// How the light of a line is spread over it, from −backward to 1.
struct LineLight {
    double backward = 1;             // how far the line reaches behind the centre, 1 being its reach ahead
    double forwardShare = 0.5;       // of the light that passes ahead of the centre
    double sphericalAberration = 0;  // Lens::sphericalAberration
    double obstruction = 0;          // share of the area
};

double lightBetween(const LineLight& light, double p1, double p2);

}  // namespace defocus::engine
