// The sharp image, over it the blurred far field where a pixel lies behind the focus, over that the near field.
#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/pinhole.glsl"

layout(binding = 0) uniform sampler2D pinholeColor;
layout(binding = 2) uniform sampler2D farBlurred;    // COMBINED: both fields
#ifndef COMBINED
layout(binding = 3) uniform sampler2D nearBlurred;
#endif
layout(location = 0) uniform float blendBias;        // ≥ 1: the near field covers what it overlaps sooner; 0: there is none
layout(location = 1) uniform float perFarDiameter;   // as in split.frag

layout(location = 0) out vec4 image;

// The radiance of a blurred field at a pixel that is part of it with weight `own`. Where the kernel's negative lobes leave less than
// a quarter of that weight, the pixel itself makes it up.
vec3 radianceOf(vec4 field, float own, vec3 sharp) {
    float missing = max(0.25 * own - field.a, 0.0);
    return max(field.rgb + missing * sharp, vec3(0.0)) / max(field.a + missing, 1e-12);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float diameter = pinholeCircleOfConfusion(pixel);
    vec3 sharp = texelFetch(pinholeColor, pixel, 0).rgb;
    vec2 place = gl_FragCoord.xy / (float(REDUCTION) * vec2(textureSize(farBlurred, 0)));
    vec4 behind = textureLod(farBlurred, place, 0.0);
    float own = clamp(diameter, 0.0, 1.0) * min(diameter * perFarDiameter, 1.0);
    float farShare = clamp(diameter - 1.0, 0.0, 1.0);   // below 2 px the disk is the pixel
#ifdef COMBINED
    own += clamp(-diameter, 0.0, 1.0);
    float share = max(farShare, clamp(behind.a * blendBias, 0.0, 1.0));
    vec3 color = mix(sharp, radianceOf(behind, own, sharp), share);
#else
    vec3 color = mix(sharp, radianceOf(behind, own, sharp), farShare);
    vec4 before = textureLod(nearBlurred, place, 0.0);
    float nearShare = clamp(before.a * blendBias, 0.0, 1.0);
    if (nearShare > 0.0) color = (1.0 - nearShare) * color + nearShare / before.a * max(before.rgb, vec3(0.0));
#endif
    image = vec4(color, 1.0);
}
