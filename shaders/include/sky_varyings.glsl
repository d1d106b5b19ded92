// Varyings (interpolated values) of the triangle that draws the sky for a lens sample.

    vec2 place;                // image position in normalised device coordinates
    flat vec4 lensAndJitter;
    flat float bandShift;
    flat float layer;
