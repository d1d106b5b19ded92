// The clip-space lens shear p' = p + C·(u, k·v, 0, 0) (Munkberg, Toth and Akenine-Möller 2012; C > 0 behind the focus plane) and
// C itself: src/lens/circle_of_confusion.h holds the mathematics. COC_CONTROLS: something changes C from a + b·w. `own` is what the
// surface makes of it: a factor, and what it adds as a share of the image's width.
// Depth is reversed with an infinite far plane: z = near, so that z/w runs from 1 at the near plane to 0.

#ifdef CHROMATIC
float bandShift = 0.0;   // what the wavelength of the lens sample at hand adds to b₁ and b₂
#else
const float bandShift = 0.0;
#endif

#ifdef COC_CONTROLS
struct CocTerms {
    float factor;   // own factor·(1 + g·r²)
    float front;    // F
    float behind;   // B
};

CocTerms cocTerms(float inverseDepth, vec2 ndc, float ownFactor) {
    float radius2 = ndc.x * ndc.x + ndc.y * ndc.y * frame.cocLimits.z;
    float focus = 1.0 + frame.cocField.z * radius2 + dot(frame.cocField.xy, ndc);
    return CocTerms(ownFactor * (1.0 + frame.cocField.w * radius2), frame.coc.x * inverseDepth + (frame.coc.y + bandShift) * focus,
                    frame.cocOther.x * inverseDepth + (frame.coc.w + bandShift) * focus);
}
#endif

// C/w, the signed diameter as a share of the image's width, at 1/w and a place in the image.
float relativeCircleOfConfusion(float inverseDepth, vec2 ndc, vec2 own) {
#ifdef COC_CONTROLS
    CocTerms terms = cocTerms(inverseDepth, ndc, own.x);
    float blur = terms.factor * (min(0.0, terms.front) + max(0.0, terms.behind)) + own.y;
    return clamp(blur, -frame.cocLimits.x, frame.cocLimits.y);
#else
    return frame.coc.x * inverseDepth + frame.coc.y + bandShift;
#endif
}

#ifdef ABERRATIONS
// What astigmatism and coma add for a lens point (u, k·v): src/lens/aberrations.h.
vec2 aberration(vec2 ndc, vec2 lensPoint) {
    vec2 perAspect = vec2(1.0, sqrt(frame.cocLimits.z));
    vec2 field = ndc * perAspect;
    vec2 lens = lensPoint * perAspect;
    float along = dot(field, lens);
    return (frame.cocOther.z * along * field + frame.cocOther.w * (2.0 * along * lens + dot(lens, lens) * field)) / perAspect;
}
#endif

// How far the image of a place at 1/w moves for a lens point (u, k·v), in normalised device units.
vec2 shiftThroughLens(float inverseDepth, vec2 ndc, vec2 own, vec2 lensPoint) {
    vec2 shift = relativeCircleOfConfusion(inverseDepth, ndc, own) * lensPoint;
#ifdef ABERRATIONS
    shift += aberration(ndc, lensPoint);
#endif
    return shift;
}

// (x, y, w) of a view-space position in the pinhole image.
vec3 pinholePosition(vec3 viewPosition) {
    return vec3(viewPosition.xy * frame.projection.xy, -viewPosition.z);
}

// Seen from a point of the lens: `lensAndJitter` holds (u, k·v) and the pixel jitter in normalised device units. With
// COC_CONTROLS the position must lie in front of the camera.
vec4 throughLens(vec3 pinhole, vec2 own, vec4 lensAndJitter) {
    float w = pinhole.z;
#ifdef COC_CONTROLS
    vec2 shift = w * shiftThroughLens(1.0 / w, pinhole.xy / w, own, lensAndJitter.xy);
#else
    vec2 shift = (frame.coc.x + (frame.coc.y + bandShift) * w) * lensAndJitter.xy;
#endif
    return vec4(pinhole.xy + shift + w * lensAndJitter.zw, frame.projection.z, w);
}

// Signed diameter of the circle of confusion in px at a value of the depth buffer (1/w times the near plane; 0 is infinity).
float circleOfConfusion(float depth, vec2 ndc, vec2 own) {
    return relativeCircleOfConfusion(depth / frame.projection.z, ndc, own) * frame.coc.z;
}

// Of a pixel of the pinhole image `size` px large.
vec2 ndcOfPixel(vec2 pixelCentre, ivec2 size) {
    return 2.0 * pixelCentre / vec2(size) - 1.0;
}
