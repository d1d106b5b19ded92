// Additional varyings of the shader stages that run before the lens shear is applied: the unsheared vertex position (x,
// y, w of clip space), the blur modifiers, and the lens sample of the instance.

    vec3 pinhole;
    vec2 ownBlur;
    flat vec4 lensAndJitter;
    flat float bandShift;
