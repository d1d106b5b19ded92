// What the stages between the vertices and the shear need beside the surface: the place in the pinhole image (x, y, w of clip
// space), the scale of the blur, and the lens sample of the instance.

    vec3 pinhole;
    float cocScale;
    flat vec4 lensAndJitter;
    flat vec2 ditherAndLayer;
    flat float bandShift;
