// Share of a line's light that passes through a part of it. Lines crowd together at the centre of the lens, so a part
// is weighted by its distance from the centre. For a disk and p ∈ [−1, 1], κ(p₁, p₂) = (p₂|p₂| − p₁|p₁|)/2. In Tzeng et
// al. 2012, p runs from −1/2 to 1/2. In general each side of the centre has its own share. Within a side, the density
// is 1 + a·(2t − 1), where t is the share of the area without the obstruction (src/lens/aperture.h).

layout(location = 4) uniform vec2 lightOverRadius;   // a; obstructed share of the area

float lightWithin(float radius) {
    float t = clamp((radius * radius - lightOverRadius.y) / (1.0 - lightOverRadius.y), 0.0, 1.0);
    return t * (1.0 - lightOverRadius.x + lightOverRadius.x * t);
}

// Returns the light from the centre to p, negative backwards. `sides`: the line's backward extent, and the share of the
// light that passes forwards.
float lightUpTo(float p, vec2 sides) {
    return p < 0.0 ? -(1.0 - sides.y) * lightWithin(-p / sides.x) : sides.y * lightWithin(p);
}

float lightBetween(float p1, float p2, vec2 sides) { return lightUpTo(p2, sides) - lightUpTo(p1, sides); }

// Returns the position between p1 and p2 that encloses the given share of the light, for a uniform disk: the inverse of
// p|p|.
float placeOfShare(float p1, float p2, float share) {
    float q = mix(p1 * abs(p1), p2 * abs(p2), share);
    return clamp(sign(q) * sqrt(abs(q)), p1, p2);
}
