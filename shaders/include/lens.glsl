// Applies the clip-space lens shear p' = p + C·(u, k·v, 0, 0) for lens point (u, v) and aspect ratio k (Munkberg, Toth
// and Akenine-Möller 2012; here C > 0 behind the focus plane). C is the signed circle of confusion times the depth w;
// src/lens/circle_of_confusion.h documents C and its terms. Without cocControls, C = a + b·w with constants a and b, as
// for a thin lens. The parameter `own` holds the surface's blur modifiers: own.x scales its blur, and own.y is added to
// it, as a fraction of the image's width. Depth is reversed with an infinite far plane: z = near, so z/w runs from 1 at
// the near plane to 0 at infinity.

// Change in the CoC coefficients b₁ and b₂ (frame.coc) due to the sample's wavelength; 0 unless chromatic.
float bandShift = 0.0;

// Terms of the signed circle of confusion (CoC) C/w, as fractions of the image's width.
struct CocTerms {
    // Blur factor of the surface times the radial gain 1 + g·r², with the distance r from the image's centre and the
    // coefficient g in frame.cocField.
    float factor;
    float front;    // lens's CoC for depths in front of the focus plane (< 0 there): a/depth + b₁·q (see frame.coc)
    float behind;   // lens's CoC for depths behind the focus plane (> 0 there): a₂/depth + b₂·q (see frame.coc)
};

CocTerms cocTerms(float inverseDepth, vec2 ndc, float ownFactor) {
    float radius2 = ndc.x * ndc.x + ndc.y * ndc.y * frame.cocLimits.z;
    float focus = 1.0 + frame.cocField.z * radius2 + dot(frame.cocField.xy, ndc);
    return CocTerms(ownFactor * (1.0 + frame.cocField.w * radius2), frame.coc.x * inverseDepth + (frame.coc.y + bandShift) * focus,
                    frame.cocOther.x * inverseDepth + (frame.coc.w + bandShift) * focus);
}

// Returns the signed diameter of the circle of confusion as a fraction of the image's width. `inverseDepth`: 1 / depth;
// `ndc`: image position in normalised device coordinates; `own`: the surface's blur modifiers.
float relativeCircleOfConfusion(float inverseDepth, vec2 ndc, vec2 own) {
    if (!cocControls) return frame.coc.x * inverseDepth + frame.coc.y + bandShift;
    CocTerms terms = cocTerms(inverseDepth, ndc, own.x);
    float blur = terms.factor * (min(0.0, terms.front) + max(0.0, terms.behind)) + own.y;
    return clamp(blur, -frame.cocLimits.x, frame.cocLimits.y);
}

// Returns the image offset, in normalised device coordinates, that astigmatism and coma cause (src/lens/aberrations.h).
// `lensPoint`: (u, k·v), where k is the image's aspect ratio.
vec2 aberration(vec2 ndc, vec2 lensPoint) {
    vec2 perAspect = vec2(1.0, sqrt(frame.cocLimits.z));
    vec2 field = ndc * perAspect;
    vec2 lens = lensPoint * perAspect;
    float along = dot(field, lens);
    return (frame.cocOther.z * along * field + frame.cocOther.w * (2.0 * along * lens + dot(lens, lens) * field)) / perAspect;
}

// Returns the image shift, in normalised device coordinates, of a point at depth 1/inverseDepth. `lensPoint`: (u, k·v),
// where k is the image's aspect ratio.
vec2 shiftThroughLens(float inverseDepth, vec2 ndc, vec2 own, vec2 lensPoint) {
    vec2 shift = relativeCircleOfConfusion(inverseDepth, ndc, own) * lensPoint;
    if (aberrations) shift += aberration(ndc, lensPoint);
    return shift;
}

// Returns the clip-space (x, y, w) of a view-space position as seen through a pinhole at the lens centre.
vec3 pinholePosition(vec3 viewPosition) {
    return vec3(viewPosition.xy * frame.projection.xy, -viewPosition.z);
}

// Returns the clip position as seen from a lens point. `pinhole`: result of pinholePosition(); with cocControls, its
// third component w must be > 0. `own`: the surface's blur modifiers. `lensAndJitter`: lens point (u, k·v), where k is
// the image's aspect ratio, and pixel jitter in normalised device coordinates.
vec4 throughLens(vec3 pinhole, vec2 own, vec4 lensAndJitter) {
    float w = pinhole.z;
    vec2 shift;
    if (cocControls)
        shift = w * shiftThroughLens(1.0 / w, pinhole.xy / w, own, lensAndJitter.xy);
    else
        shift = (frame.coc.x + (frame.coc.y + bandShift) * w) * lensAndJitter.xy;
    return vec4(pinhole.xy + shift + w * lensAndJitter.zw, frame.projection.z, w);
}

// Returns the signed diameter of the circle of confusion in px for a depth-buffer value near / w, which is 0 at
// infinity.
float circleOfConfusion(float depth, vec2 ndc, vec2 own) {
    return relativeCircleOfConfusion(depth / frame.projection.z, ndc, own) * frame.coc.z;
}

// Returns the normalised device coordinates of a pixel in an image of `size` px.
vec2 ndcOfPixel(vec2 pixelCentre, ivec2 size) {
    return 2.0 * pixelCentre / vec2(size) - 1.0;
}
