// Writes a bucket's nearest surface: its depth and its blur modifiers. Mip levels average them with the last channel as
// weight.

layout(binding = 0) uniform sampler2D surfaceDepth;
layout(binding = 1) uniform sampler2D surfaceOwnBlur;   // only with usesOwnBlur

layout(location = 0) out vec4 known;   // depth, blur factor, added blur, 1; 0 without a surface

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(surfaceDepth, pixel, 0).r;
    vec2 own = vec2(1.0, 0.0);
    if (usesOwnBlur) own = texelFetch(surfaceOwnBlur, pixel, 0).rg;
    known = depth > 0.0 ? vec4(depth, own, 1.0) : vec4(0.0);
}
