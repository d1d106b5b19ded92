// Varyings that the stages before the lens shear pass on, in addition to the surface attributes: the vertex position
// before the shear (x, y, w of clip space), the blur modifiers, and the lens sample of the instance.

    vec3 pinhole;
    vec2 ownBlur;
    flat vec4 lensAndJitter;
    flat float bandShift;
