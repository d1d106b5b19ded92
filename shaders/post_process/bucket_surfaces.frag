// Where a bucket has surfaces: the depth of the nearest, and what it makes of the blur. Mipmaps average it with the last channel as
// weight.

layout(binding = 0) uniform sampler2D surfaceDepth;
#ifdef OWN_BLUR
layout(binding = 1) uniform sampler2D surfaceOwnBlur;
#endif

layout(location = 0) out vec4 known;   // depth, factor, what is added, 1; or nothing

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
