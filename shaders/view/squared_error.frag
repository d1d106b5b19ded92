// Computes the squared difference of two images' sRGB-encoded values at EV 0, averaged over the channels.

#include "include/tone_map.glsl"

layout(binding = 0) uniform sampler2D firstImage;
layout(binding = 1) uniform sampler2D secondImage;

layout(location = 0) out float squaredError;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 difference = displayEncoded(texelFetch(firstImage, pixel, 0).rgb, 1.0, 0) -
                      displayEncoded(texelFetch(secondImage, pixel, 0).rgb, 1.0, 0);
    squaredError = dot(difference, difference) / 3.0;
}
