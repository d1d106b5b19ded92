// The pinhole image as the circular method reads it. With brackets (storage r10g10b10a2), radiance has ten bits per
// channel from 0 to 1, and is clipped above 1.

layout(binding = 0) uniform sampler2D pinholeColor;

// Rounds values in [0, 1] to ten bits each.
vec4 inTenBits(vec4 values) {
    return round(clamp(values, 0.0, 1.0) * 1023.0) / 1023.0;
}

vec3 clearColor(ivec2 pixel) {
    vec3 color = texelFetch(pinholeColor, pixel, 0).rgb;
    return bracketed ? inTenBits(vec4(color, 1.0)).rgb : color;
}
