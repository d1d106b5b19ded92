// Computes the blur of a pixel in the pinhole image from the pixel's depth and from its surface's blur modifiers (a
// factor and an added blur).

#ifdef MULTISAMPLED
#define PinholeTexture sampler2DMS
#else
#define PinholeTexture sampler2D
#endif

layout(binding = 1) uniform PinholeTexture pinholeDepth;
// x: factor by which the surface scales its blur; y: blur that it adds. Used only with usesOwnBlur.
layout(binding = 6) uniform PinholeTexture pinholeOwnBlur;

// Returns the size of the pinhole image in px.
ivec2 pinholeSize() {
#ifdef MULTISAMPLED
    return textureSize(pinholeDepth);
#else
    return textureSize(pinholeDepth, 0);
#endif
}

// Returns the signed diameter of the circle of confusion in px, for sample `index` of the pixel.
float pinholeCircleOfConfusion(ivec2 pixel, int index) {
    vec2 own = vec2(1.0, 0.0);
    if (usesOwnBlur) own = texelFetch(pinholeOwnBlur, pixel, index).rg;
    vec2 ndc = ndcOfPixel(vec2(pixel) + 0.5, pinholeSize());
    return circleOfConfusion(texelFetch(pinholeDepth, pixel, index).r, ndc, own);
}
