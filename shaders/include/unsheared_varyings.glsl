// What the stages between the vertices and the shear need beside the surface: the place in the pinhole image (x, y, w of clip
// space), what the surface makes of the blur, and the lens sample of the instance.

    vec3 pinhole;
    vec2 ownBlur;
    flat vec4 lensAndJitter;
    flat vec2 ditherAndLayer;
    flat float bandShift;
