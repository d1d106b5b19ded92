// Writes the attributes of the surface `s` to the varyings SURFACE_OUT.

void writeSurface(Surface s) {
    SURFACE_OUT.color = s.color;
    SURFACE_OUT.sampleNumber = s.sampleNumber;
    SURFACE_OUT.layer = s.layer;
#ifdef CHOOSES_BY_ALPHA
    SURFACE_OUT.facet = s.facet;
#endif
#ifdef COLOR_RANGES
    SURFACE_OUT.minColor = s.minColor;
    SURFACE_OUT.maxColor = s.maxColor;
#endif
#if defined(LIT) || defined(NORMAL_SLOT)
    SURFACE_OUT.normal = s.normal;
#endif
#ifdef LIT
    SURFACE_OUT.toEye = s.toEye;
#endif
#ifdef COARSE_LEVEL
    SURFACE_OUT.agreement = s.agreement;
#endif
#ifdef PLACED
    SURFACE_OUT.position = s.position;
    SURFACE_OUT.lensAndBand = vec3(s.lens, s.bandShift);
#endif
#ifdef TEXTURED
    SURFACE_OUT.uv = s.uv;
#endif
#ifdef BUMPED
    SURFACE_OUT.tangent = s.tangent;
#endif
#ifdef PASSES_OWN_BLUR
    SURFACE_OUT.ownBlur = s.ownBlur;
#endif
#ifdef MOTION_SLOT
    SURFACE_OUT.opening = s.opening;
    SURFACE_OUT.closing = s.closing;
#endif
}
