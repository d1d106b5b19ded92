// Blur of a pixel in the pinhole image, computed from its depth and its surface's blur modifiers.

layout(binding = 1) uniform sampler2D pinholeDepth;
layout(binding = 6) uniform sampler2D pinholeOwnBlur;   // only with usesOwnBlur

// Returns the signed diameter of the circle of confusion in px.
float pinholeCircleOfConfusion(ivec2 pixel) {
    vec2 own = vec2(1.0, 0.0);
    if (usesOwnBlur) own = texelFetch(pinholeOwnBlur, pixel, 0).rg;
    vec2 ndc = ndcOfPixel(vec2(pixel) + 0.5, textureSize(pinholeDepth, 0));
    return circleOfConfusion(texelFetch(pinholeDepth, pixel, 0).r, ndc, own);
}
