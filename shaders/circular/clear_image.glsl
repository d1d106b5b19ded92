// Reads the pinhole image for the circular method. If images are stored with ten bits per channel (`bracketed`),
// radiance is clipped to [0, 1] and rounded to ten bits.

layout(binding = 0) uniform sampler2D pinholeColor;

// Rounds values in [0, 1] to ten bits each.
vec4 inTenBits(vec4 values) {
    return round(clamp(values, 0.0, 1.0) * 1023.0) / 1023.0;
}

vec3 clearColor(ivec2 pixel) {
    vec3 color = texelFetch(pinholeColor, pixel, 0).rgb;
    return bracketed ? inTenBits(vec4(color, 1.0)).rgb : color;
}
