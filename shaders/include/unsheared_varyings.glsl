// Varyings of the stages before the lens shear, in addition to the surface: pinhole position (x, y, w of clip space),
// blur modifiers, and the lens sample of the instance.

    vec3 pinhole;
    vec2 ownBlur;
    flat vec4 lensAndJitter;
    flat float bandShift;
