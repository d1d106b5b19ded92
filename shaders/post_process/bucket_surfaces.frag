// Writes the depth and the blur modifiers of the nearest surface of a bucket, a group of alpha-blended objects of
// similar depth. Alpha is 1, or 0 without a surface, and serves as the weight of averages in mip levels.

layout(binding = 0) uniform sampler2D surfaceDepth;
layout(binding = 1) uniform sampler2D surfaceOwnBlur;   // blur factor and added blur; used only with usesOwnBlur

layout(location = 0) out vec4 known;   // reversed depth, blur factor, added blur, 1; all 0 without a surface

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(surfaceDepth, pixel, 0).r;
    vec2 own = vec2(1.0, 0.0);
    if (usesOwnBlur) own = texelFetch(surfaceOwnBlur, pixel, 0).rg;
    known = depth > 0.0 ? vec4(depth, own, 1.0) : vec4(0.0);
}
