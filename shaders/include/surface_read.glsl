// Returns the surface read from its varyings. The macro SURFACE_IN is an expression for the varyings' block; it may use
// `corner`, the index of a corner of the triangle. Attributes that the material doesn't need are 0, except the blur
// modifiers ownBlur, which are then (1, 0): factor 1 and no added blur.

Surface surfaceAt(int corner) {
    Surface s = Surface(vec4(0.0), vec4(0.0), vec4(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0), vec2(0.0), 0.0, vec4(0.0),
                        vec4(0.0), vec2(1.0, 0.0), 0, 0.0, 0.0, vec3(0.0), vec3(0.0));
    s.color = SURFACE_IN.color;
    s.sampleNumber = SURFACE_IN.sampleNumber;
    s.layer = SURFACE_IN.layer;
#ifdef CHOOSES_BY_ALPHA
    s.facet = SURFACE_IN.facet;
#endif
#ifdef COLOR_RANGES
    s.minColor = SURFACE_IN.minColor;
    s.maxColor = SURFACE_IN.maxColor;
#endif
#if defined(LIT) || defined(NORMAL_SLOT)
    s.normal = SURFACE_IN.normal;
#endif
#ifdef LIT
    s.toEye = SURFACE_IN.toEye;
#endif
#ifdef COARSE_LEVEL
    s.agreement = SURFACE_IN.agreement;
#endif
#ifdef PLACED
    s.position = SURFACE_IN.position;
    s.lens = SURFACE_IN.lensAndBand.xy;
    s.bandShift = SURFACE_IN.lensAndBand.z;
#endif
#ifdef TEXTURED
    s.uv = SURFACE_IN.uv;
#endif
#ifdef BUMPED
    s.tangent = SURFACE_IN.tangent;
#endif
#ifdef PASSES_OWN_BLUR
    s.ownBlur = SURFACE_IN.ownBlur;
#endif
#ifdef MOTION_SLOT
    s.opening = SURFACE_IN.opening;
    s.closing = SURFACE_IN.closing;
#endif
    return s;
}
