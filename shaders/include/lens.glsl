// The clip-space lens shear p' = p + C·(u, k·v, 0, 0) (Munkberg, Toth and Akenine-Möller 2012; C > 0 behind the focus plane) and
// C itself: src/lens/circle_of_confusion.h holds the mathematics. COC_CONTROLS: something changes C from a + b·w.
// Depth is reversed with an infinite far plane: z = near, so that z/w runs from 1 at the near plane to 0.

#ifdef CHROMATIC
float bandShift = 0.0;   // what the wavelength of the lens sample at hand adds to b₁ and b₂
#else
const float bandShift = 0.0;
#endif

#ifdef COC_CONTROLS
struct CocTerms {
    float factor;   // scale·(1 + g·r²)
    float front;    // F
    float behind;   // B
};

CocTerms cocTerms(float inverseDepth, vec2 ndc, float scale) {
    float radius2 = ndc.x * ndc.x + ndc.y * ndc.y * frame.cocLimits.z;
    float focus = 1.0 + frame.cocField.z * radius2 + dot(frame.cocField.xy, ndc);
    return CocTerms(scale * (1.0 + frame.cocField.w * radius2), frame.coc.x * inverseDepth + (frame.coc.y + bandShift) * focus,
                    frame.coc.x * inverseDepth + (frame.coc.w + bandShift) * focus);
}
#endif

// C/w, the signed diameter as a share of the image's width, at 1/w and a place in the image, of a surface with `scale`.
float relativeCircleOfConfusion(float inverseDepth, vec2 ndc, float scale) {
#ifdef COC_CONTROLS
    CocTerms terms = cocTerms(inverseDepth, ndc, scale);
    return clamp(terms.factor * (min(0.0, terms.front) + max(0.0, terms.behind)), -frame.cocLimits.x, frame.cocLimits.y);
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
vec4 throughLens(vec3 pinhole, float scale, vec4 lensAndJitter) {
    float w = pinhole.z;
#ifdef COC_CONTROLS
    float c = w * relativeCircleOfConfusion(1.0 / w, pinhole.xy / w, scale);
#else
    float c = frame.coc.x + (frame.coc.y + bandShift) * w;
#endif
#ifdef PIXEL_RATE
    // Variances add: what larger pixels blur, the lens doesn't.
    float diameter = c / w * frame.coc.z;
    c *= sqrt(max(1.0 - frame.projection.w / max(diameter * diameter, 1e-6), 0.0));
    vec2 place = pinhole.xy + c * lensAndJitter.xy + w * lensAndJitter.zw;
    return vec4(place * frame.pixelGrid.xy + w * frame.pixelGrid.zw, frame.projection.z, w);
#else
    return vec4(pinhole.xy + c * lensAndJitter.xy + w * lensAndJitter.zw, frame.projection.z, w);
#endif
}

// Signed diameter of the circle of confusion in px at a value of the depth buffer (1/w times the near plane; 0 is infinity).
float circleOfConfusion(float depth, vec2 ndc, float scale) {
    return relativeCircleOfConfusion(depth / frame.projection.z, ndc, scale) * frame.coc.z;
}

// Of a pixel of the pinhole image `size` px large.
vec2 ndcOfPixel(vec2 pixelCentre, ivec2 size) {
    return 2.0 * pixelCentre / vec2(size) - 1.0;
}
