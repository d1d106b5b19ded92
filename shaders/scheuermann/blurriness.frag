// Stores blurriness and relative depth in the pinhole image's alpha. The range −1 (in front) … 0 (in focus) … 1
// (behind) is stored as [0, 1].
#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/pinhole.glsl"
#include "include/tone_map.glsl"

layout(binding = 0) uniform sampler2D pinholeColor;
layout(location = 0) uniform float perLargest;   // 1 / max diameter, px
layout(location = 1) uniform vec4 planes;        // focus (m), 1/(focus − near), 1/(far − focus), cutoff behind

layout(location = 0) out vec4 colorAndBlurriness;

// Returns the blurriness by planes, linear in depth, as published.
float blurrinessByPlanes(ivec2 pixel) {
    float depth = texelFetch(pinholeDepth, pixel, 0).r;
    // Infinite depth counts as the farthest distance behind the focus.
    float beyondFocus = depth > 0.0 ? frame.projection.z / depth - planes.x : 3.0e38;
    float blurriness = beyondFocus < 0.0 ? beyondFocus * planes.y : min(beyondFocus * planes.z, planes.w);
    return frame.coc.x == 0.0 ? 0.0 : blurriness;   // 0: pinhole
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float blurriness = thinLens ? pinholeCircleOfConfusion(pixel) * perLargest : blurrinessByPlanes(pixel);
    vec3 color = texelFetch(pinholeColor, pixel, 0).rgb;
    if (encodedColor) color = srgbEncoded(color);
    colorAndBlurriness = vec4(color, clamp(blurriness, -1.0, 1.0) * 0.5 + 0.5);
}
