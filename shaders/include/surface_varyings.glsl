// What the vertex stage hands to the fragment stage; only what the material needs.

    vec4 color;
#ifdef VERTEX_COLOR_RANGES
    flat vec4 minColor; // what the corners around have
    flat vec4 maxColor;
#endif
#ifndef UNLIT
    vec3 normal;          // along the world's axes, as all directions here
#ifdef COARSE_LEVEL
    float agreement;      // of the normals that a coarse level's normal stands for: the length of their mean, ≤ 1
#endif
    vec3 toEye;           // to this sample's point on the lens
#endif
#if defined(LOCAL_LIGHTS) || defined(TRANSMISSION) || (defined(SHADOWS) && !defined(UNLIT))
    vec3 position;        // from the camera
#endif
#ifdef TRANSMISSION
    flat vec2 lens;       // of the lens sample: (u, k·v)
    flat float bandShift;
#endif
#ifdef TEXTURED
    vec4 uv;              // both UV sets
#endif
#ifdef TANGENTS
    vec4 tangent;
#endif
#if defined(OWN_BLUR) && defined(READS_OWN_BLUR)
    vec2 ownBlur;         // the surface's factor on the blur, and what it adds as a share of the image's width
#endif
