// Computes the fraction of a line's light that passes through a part [p₁, p₂] of the line. Lines are denser near the
// lens centre, so parts are weighted by their distance from the centre. For a disk and positions p ∈ [−1, 1] along the
// line, the fraction is κ(p₁, p₂) = (p₂|p₂| − p₁|p₁|)/2 (Tzeng et al. 2012, with p from −1/2 to 1/2). In general,
// different fractions of the light pass on the two sides of the centre. Within a side, the density of the light is 1 +
// a·(2t − 1), with the coefficient a of spherical aberration and the fraction t of the unobstructed area that lies
// nearer to the centre than the point (src/lens/aperture.h). If areaWeights is false, parts are weighted by their
// length alone, without κ (Figure 4 of the paper).

// x: coefficient a of the light density 1 + a·(2t − 1), where t is the fraction of the unobstructed aperture area that
// lies nearer to the centre than the point; y: fraction of the aperture's area that a central obstruction covers.
layout(location = 4) uniform vec2 lightOverRadius;

float lightWithin(float radius) {
    if (!areaWeights) return radius;
    float t = clamp((radius * radius - lightOverRadius.y) / (1.0 - lightOverRadius.y), 0.0, 1.0);
    return t * (1.0 - lightOverRadius.x + lightOverRadius.x * t);
}

// Returns the light through the part of the line between the lens centre and p, as a fraction of the light through the
// whole line; negative for p < 0. The line's points have positions p from −sides.x to 1. sides.x: length of the part
// with p < 0. sides.y: fraction of the line's light that passes through the part with p > 0.
float lightUpTo(float p, vec2 sides) {
    return p < 0.0 ? -(1.0 - sides.y) * lightWithin(-p / sides.x) : sides.y * lightWithin(p);
}

float lightBetween(float p1, float p2, vec2 sides) { return lightUpTo(p2, sides) - lightUpTo(p1, sides); }

// Returns the position p for which [p1, p] contains the fraction `share` of the light in [p1, p2], for a uniform disk.
// The light between the centre and p is proportional to p|p|; the function inverts this relation.
float placeOfShare(float p1, float p2, float share) {
    if (!areaWeights) return mix(p1, p2, share);
    float q = mix(p1 * abs(p1), p2 * abs(p2), share);
    return clamp(sign(q) * sqrt(abs(q)), p1, p2);
}
