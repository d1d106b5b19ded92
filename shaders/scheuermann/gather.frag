// Blurs each pixel by gathering diskTaps taps of a Poisson disk, or of the aperture's shape, scaled to the pixel's
// blur.
#include "include/tone_map.glsl"

layout(binding = 0) uniform sampler2D sharpImage;   // alpha: blurriness from blurriness.frag, 1/2 in focus
layout(binding = 1) uniform sampler2D smallImage;   // reduced and pre-blurred version of sharpImage
layout(std140, binding = 1) uniform TapBlock {
    vec4 taps[maxDiskTaps];                           // xy: position in the unit disk
};
layout(location = 0) uniform float largestRadius;   // max blur radius, px
layout(location = 1) uniform bool shaped;           // taps follow the aperture's shape instead of a disk

layout(location = 0) out vec4 blurred;

void main() {
    vec2 perPixel = 1.0 / vec2(textureSize(sharpImage, 0));
    // Size of a pixel of sharpImage in texture coordinates of smallImage.
    vec2 perPixelSmall = 1.0 / (smallPixel * vec2(textureSize(smallImage, 0)));
    float centreDepth = texelFetch(sharpImage, ivec2(gl_FragCoord.xy), 0).a;
    float radius = abs(centreDepth * 2.0 - 1.0) * largestRadius;
    // The blur of a point has the shape of the aperture, upright behind the focus plane and rotated by 180° in front of
    // it. Gathering rotates the shape by 180°, so taps change sign behind the focus plane.
    if (shaped && centreDepth > 0.5) radius = -radius;
    float smallRadius = radius * smallRadiusScale * smallPixel;

    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < diskTaps; ++i) {
        vec4 sharpTap = textureLod(sharpImage, (gl_FragCoord.xy + taps[i].xy * radius) * perPixel, 0.0);
        vec4 smallTap = textureLod(smallImage, (gl_FragCoord.xy + taps[i].xy * smallRadius) * perPixelSmall, 0.0);
        vec4 tap = mix(sharpTap, smallTap, abs(sharpTap.a * 2.0 - 1.0));
        // A tap that is nearer to the camera than the centre is weighted by the tap's own blur, so that sharp
        // foreground does not leak into its surroundings.
        float weight = tap.a >= centreDepth ? 1.0 : abs(tap.a * 2.0 - 1.0);
        sum += weight * tap.rgb;
        weights += weight;
    }
    vec3 color = weights > 0.0 ? sum / weights : texelFetch(sharpImage, ivec2(gl_FragCoord.xy), 0).rgb;
    blurred = vec4(encodedColor ? srgbDecoded(color) : color, 1.0);
}
