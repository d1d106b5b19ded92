// Sets SURFACE_OUT.… = Σ weights·corner.… over the corners of a triangle, with the varyings SURFACE_CORNERS[0 … 2].
// Used by stages that create vertices. On an edge (one weight 0), both adjacent triangles obtain the same sum.

#define SURFACE_WEIGHTED(member) \
    (weights.x * SURFACE_CORNERS[0].member + weights.y * SURFACE_CORNERS[1].member + weights.z * SURFACE_CORNERS[2].member)

void writeSurface(vec3 weights) {
    SURFACE_OUT.color = SURFACE_WEIGHTED(color);
#ifdef VERTEX_COLOR_RANGES
    SURFACE_OUT.minColor = SURFACE_CORNERS[0].minColor;
    SURFACE_OUT.maxColor = SURFACE_CORNERS[0].maxColor;
#endif
#ifndef UNLIT
    SURFACE_OUT.normal = SURFACE_WEIGHTED(normal);
#ifdef COARSE_LEVEL
    SURFACE_OUT.agreement = SURFACE_WEIGHTED(agreement);
#endif
    SURFACE_OUT.toEye = SURFACE_WEIGHTED(toEye);
#endif
#if defined(LOCAL_LIGHTS) || defined(TRANSMISSION) || (defined(SHADOWS) && !defined(UNLIT))
    SURFACE_OUT.position = SURFACE_WEIGHTED(position);
#endif
#ifdef TRANSMISSION
    SURFACE_OUT.lens = SURFACE_CORNERS[0].lens;
    SURFACE_OUT.bandShift = SURFACE_CORNERS[0].bandShift;
#endif
#ifdef TEXTURED
    SURFACE_OUT.uv = SURFACE_WEIGHTED(uv);
#endif
#ifdef TANGENTS
    SURFACE_OUT.tangent = SURFACE_WEIGHTED(tangent);
#endif
#if defined(OWN_BLUR) && defined(READS_OWN_BLUR)
    SURFACE_OUT.ownBlur = SURFACE_WEIGHTED(ownBlur);
#endif
}
