// The blur of a pixel of the pinhole image, from its depth and, where surfaces scale their blur, that scale.

layout(binding = 1) uniform sampler2D pinholeDepth;
#ifdef COC_SCALES
layout(binding = 6) uniform sampler2D pinholeCocScale;
#endif

// Signed diameter in px.
float pinholeCircleOfConfusion(ivec2 pixel) {
#ifdef COC_SCALES
    float scale = texelFetch(pinholeCocScale, pixel, 0).r;
#else
    const float scale = 1.0;
#endif
    vec2 ndc = ndcOfPixel(vec2(pixel) + 0.5, textureSize(pinholeDepth, 0));
    return circleOfConfusion(texelFetch(pinholeDepth, pixel, 0).r, ndc, scale);
}
