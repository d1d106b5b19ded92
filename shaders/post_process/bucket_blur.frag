// Chooses the depth and blur modifiers with which each pixel of a bucket (a group of alpha-blended objects of similar
// depth) is blurred. They come from the bucket's surface in the pixel; without such a surface, they are the mean over
// the bucket's surfaces around the pixel. If an opaque surface is nearer, its depth and modifiers are used instead.
// Blur is linear in reversed depth, so the mean depth has the mean blur.

layout(binding = 0) uniform sampler2D known;         // output of bucket_surfaces.frag, with mip levels
layout(binding = 1) uniform sampler2D opaqueDepth;
layout(binding = 2) uniform sampler2D opaqueOwnBlur;   // blur modifiers of opaque surfaces; used only with usesOwnBlur

layout(location = 0) out float depth;
layout(location = 1) out vec2 ownBlur;                 // blur factor, added blur; written only with usesOwnBlur

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
    if (usesOwnBlur) ownBlur = hidden ? texelFetch(opaqueOwnBlur, pixel, 0).rg : ofBucket.yz;
}
