// Varyings from the vertex stage to the fragment stage, limited to those that the material needs.

    vec4 color;
#ifdef VERTEX_COLOR_RANGES
    flat vec4 minColor; // min over the adjacent corners
    flat vec4 maxColor;
#endif
#ifndef UNLIT
    vec3 normal;          // in world axes, like all directions here
#ifdef COARSE_LEVEL
    float agreement;      // coarse levels: length of the mean of the represented normals, ≤ 1
#endif
    vec3 toEye;           // towards this sample's lens point
#endif
#if defined(LOCAL_LIGHTS) || defined(TRANSMISSION) || (defined(SHADOWS) && !defined(UNLIT))
    vec3 position;        // relative to the camera
#endif
#ifdef TRANSMISSION
    flat vec2 lens;       // lens point (u, k·v) of the sample
    flat float bandShift;
#endif
#ifdef TEXTURED
    vec4 uv;              // both UV sets
#endif
#ifdef TANGENTS
    vec4 tangent;
#endif
#if defined(OWN_BLUR) && defined(READS_OWN_BLUR)
    vec2 ownBlur;         // the surface's blur factor, and its added blur as a fraction of the image's width
#endif
