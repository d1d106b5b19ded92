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

// (x, y, w) of a view-space position in the pinhole image.
vec3 pinholePosition(vec3 viewPosition) {
    return vec3(viewPosition.xy * frame.projection.xy, -viewPosition.z);
}

// Seen from a point of the lens: `lensAndJitter` holds (u, k·v) and the pixel jitter in normalised device units. With
// COC_CONTROLS the position must lie in front of the camera.
vec4 throughLens(vec3 pinhole, vec2 own, vec4 lensAndJitter) {
    float w = pinhole.z;
#ifdef COC_CONTROLS
    float c = w * relativeCircleOfConfusion(1.0 / w, pinhole.xy / w, own);
#else
    float c = frame.coc.x + (frame.coc.y + bandShift) * w;
#endif
    return vec4(pinhole.xy + c * lensAndJitter.xy + w * lensAndJitter.zw, frame.projection.z, w);
}

// Signed diameter of the circle of confusion in px at a value of the depth buffer (1/w times the near plane; 0 is infinity).
float circleOfConfusion(float depth, vec2 ndc, vec2 own) {
    return relativeCircleOfConfusion(depth / frame.projection.z, ndc, own) * frame.coc.z;
}

// Of a pixel of the pinhole image `size` px large.
vec2 ndcOfPixel(vec2 pixelCentre, ivec2 size) {
    return 2.0 * pixelCentre / vec2(size) - 1.0;
}
