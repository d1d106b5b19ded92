// The clip-space lens shear: C(w) = a + b·w, p' = p + C(w)·(u, k·v, 0, 0)   (Munkberg, Toth and Akenine-Möller 2012, C > 0
// behind the focus plane). `lensAndJitter` holds (u, k·v) and the pixel jitter in normalised device units.
// Depth is reversed with an infinite far plane: z = near, so that z/w runs from 1 at the near plane to 0.

vec4 projectedThroughLens(vec3 viewPosition, vec4 lensAndJitter) {
    float w = -viewPosition.z;
    float c = frame.coc.x + frame.coc.y * w;
    vec2 pinhole = viewPosition.xy * frame.projection.xy;
    return vec4(pinhole + c * lensAndJitter.xy + w * lensAndJitter.zw, frame.projection.z, w);
}

// Signed diameter of the circle of confusion in px, > 0 behind the focus plane, at a value of the depth buffer (1/w times the
// near plane; 0 is infinity).
float circleOfConfusion(float depth) {
    return (frame.coc.x * depth / frame.projection.z + frame.coc.y) * frame.coc.z;
}
