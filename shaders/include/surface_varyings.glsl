// Members of the interface block SurfaceVaryings; struct Surface in surface.glsl explains them.

    vec4 color;
    flat float sampleNumber;
    flat float layer;
#ifdef CHOOSES_BY_ALPHA
    flat int facet;
#endif
#ifdef COLOR_RANGES
    flat vec4 minColor;
    flat vec4 maxColor;
#endif
#if defined(LIT) || defined(NORMAL_SLOT)
    vec3 normal;
#endif
#ifdef LIT
    vec3 toEye;
#endif
#ifdef COARSE_LEVEL
    float agreement;
#endif
#ifdef PLACED
    vec3 position;
    flat vec3 lensAndBand;   // Surface::lens, Surface::bandShift
#endif
#ifdef TEXTURED
    vec4 uv;
#endif
#ifdef BUMPED
    vec4 tangent;
#endif
#ifdef PASSES_OWN_BLUR
    vec2 ownBlur;
#endif
#ifdef MOTION_SLOT
    vec3 opening;
    vec3 closing;
#endif
