// Chooses the blur of each pixel of a bucket. It is the blur of the bucket's surface, or of the mean of the nearest
// surfaces if there is none. A nearer opaque surface overrides both. Blur is linear in reversed depth, so the mean
// depth has the mean blur.

layout(binding = 0) uniform sampler2D known;         // from bucket_surfaces.frag, with mip levels
layout(binding = 1) uniform sampler2D opaqueDepth;
#ifdef OWN_BLUR
layout(binding = 2) uniform sampler2D opaqueOwnBlur;
#endif

layout(location = 0) out float depth;
#ifdef OWN_BLUR
layout(location = 1) out vec2 ownBlur;
#endif

vec3 nearestKnown(ivec2 pixel) {
    vec4 sum = texelFetch(known, pixel, 0);
    vec2 place = gl_FragCoord.xy / vec2(textureSize(known, 0));
    int levels = textureQueryLevels(known);
    for (int level = 1; level < levels && sum.a == 0.0; ++level) sum = textureLod(known, place, float(level));
    return sum.a > 0.0 ? sum.rgb / sum.a : vec3(0.0);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 ofBucket = nearestKnown(pixel);
    float opaque = texelFetch(opaqueDepth, pixel, 0).r;
    bool hidden = opaque > ofBucket.x;
    depth = hidden ? opaque : ofBucket.x;
#ifdef OWN_BLUR
    ownBlur = hidden ? texelFetch(opaqueOwnBlur, pixel, 0).rg : ofBucket.yz;
#endif
}
