// Writes a bucket's nearest surface: its depth and its blur modifiers. Mip levels average them with the last channel as
// weight.

layout(binding = 0) uniform sampler2D surfaceDepth;
#ifdef OWN_BLUR
layout(binding = 1) uniform sampler2D surfaceOwnBlur;
#endif

layout(location = 0) out vec4 known;   // depth, blur factor, added blur, 1; 0 without a surface

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(surfaceDepth, pixel, 0).r;
#ifdef OWN_BLUR
    vec2 own = texelFetch(surfaceOwnBlur, pixel, 0).rg;
#else
    const vec2 own = vec2(1.0, 0.0);
#endif
    known = depth > 0.0 ? vec4(depth, own, 1.0) : vec4(0.0);
}
