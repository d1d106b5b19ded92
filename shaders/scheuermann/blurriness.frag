// Stores the signed blurriness of the pinhole image in alpha; blurriness also orders surfaces by depth. It is −1 at
// max blur in front of the focus plane, 0 in focus and 1 at max blur behind the focus plane; [−1, 1] is stored as [0,
// 1]. With several samples per pixel, writes their mean, like the resolve of a multisampled back buffer that has
// blurriness in alpha.
#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/pinhole.glsl"
#include "include/tone_map.glsl"

layout(binding = 0) uniform PinholeTexture pinholeColor;
layout(location = 0) uniform float perLargest;   // reciprocal of the largest CoC diameter, 1/px
// x: focus distance (m); y: 1/(focus distance − near plane); z: 1/(far plane − focus distance); w: max blurriness
// behind the focus plane.
layout(location = 1) uniform vec4 planes;

layout(location = 0) out vec4 colorAndBlurriness;

// Returns the blurriness as in Scheuermann 2004: linear in depth, −1 at the near plane, 0 at the focus plane, 1 at the
// far plane.
float blurrinessByPlanes(ivec2 pixel, int index) {
    float depth = texelFetch(pinholeDepth, pixel, index).r;
    // Infinite depth counts as 3e38 m behind the focus plane.
    float beyondFocus = depth > 0.0 ? frame.projection.z / depth - planes.x : 3.0e38;
    float blurriness = beyondFocus < 0.0 ? beyondFocus * planes.y : min(beyondFocus * planes.z, planes.w);
    return frame.coc.x == 0.0 ? 0.0 : blurriness;   // a pinhole has no blur; its CoC a/depth + b has a = 0
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    colorAndBlurriness = vec4(0.0);
    for (int i = 0; i < pinholeSamples; ++i) {
        float blurriness = thinLens ? pinholeCircleOfConfusion(pixel, i) * perLargest : blurrinessByPlanes(pixel, i);
        vec3 color = texelFetch(pinholeColor, pixel, i).rgb;
        if (encodedColor) color = srgbEncoded(color);
        colorAndBlurriness += vec4(color, clamp(blurriness, -1.0, 1.0) * 0.5 + 0.5) / float(pinholeSamples);
    }
}
