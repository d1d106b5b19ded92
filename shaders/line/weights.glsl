// What share of a line's light passes through a part of it. Lines through the centre of the lens lie close to each other there, so a
// part counts with its distance from the centre: κ(p₁, p₂) = (p₂|p₂| − p₁|p₁|)/2 for a disk and p from −1 to 1 (Tzeng et al. 2012, whose
// p goes from −1/2 to 1/2). In general each side of the centre has a share of its own, and the light within it follows the density
// 1 + a·(2t − 1) of the share t of the area, less an obstructed middle (src/lens/aperture.h).

layout(location = 4) uniform vec2 lightOverRadius;   // a; share of the area that is obstructed

float lightWithin(float radius) {
    float t = clamp((radius * radius - lightOverRadius.y) / (1.0 - lightOverRadius.y), 0.0, 1.0);
    return t * (1.0 - lightOverRadius.x + lightOverRadius.x * t);
}

// From the centre to p, < 0 backwards. `sides`: how far the line reaches backwards; share of the light that passes forwards.
float lightUpTo(float p, vec2 sides) {
    return p < 0.0 ? -(1.0 - sides.y) * lightWithin(-p / sides.x) : sides.y * lightWithin(p);
}

float lightBetween(float p1, float p2, vec2 sides) { return lightUpTo(p2, sides) - lightUpTo(p1, sides); }

// Where the given share of the light between p1 and p2 has passed, for a disk of even light: the inverse of p|p|.
float placeOfShare(float p1, float p2, float share) {
    float q = mix(p1 * abs(p1), p2 * abs(p2), share);
    return clamp(sign(q) * sqrt(abs(q)), p1, p2);
}
