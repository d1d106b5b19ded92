// Composites the blurred far field over the sharp image, and the blurred near field over both. The far field covers
// only pixels behind the focus plane. A pixel of a field (field pixel) covers reduction × reduction image pixels.
#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/pinhole.glsl"
#include "circular/clear_image.glsl"

layout(binding = 2) uniform sampler2D farBlurred;
layout(binding = 3) uniform sampler2D nearBlurred;
layout(binding = 4) uniform sampler2D nearRadii;     // blur radius of the near field, in field pixels
layout(location = 2) uniform float perNearDiameter;  // 1 / (largest CoC diameter in px in front of the focus plane)
// 0: there is no near field. ≥ 1: factor by which the near field's coverage is multiplied.
layout(location = 0) uniform float blendBias;
layout(location = 1) uniform float perFarDiameter;   // 1 / (largest CoC diameter in px behind the focus plane)

layout(location = 0) out vec4 image;

// Returns the radiance of a blurred field at a pixel that belongs to the field with weight `own`. The kernel's negative
// lobes may reduce the blurred weight to less than own/4. The sharp pixel then supplies the missing weight.
vec3 radianceOf(vec4 field, float own, vec3 sharp) {
    float missing = max(0.25 * own - field.a, 0.0);
    return max(field.rgb + missing * sharp, vec3(0.0)) / max(field.a + missing, 1e-12);
}

// Returns the near field's coverage of a pixel, from the blurred weight `weight`.
float coverageOf(float weight, vec2 place) {
    if (nearPremultiplied) {
        // Divide the blurred weight by the weight that split.frag gives to a surface whose blur radius equals the
        // radius that this pixel is blurred with (nearRadii). Surfaces with this blur then cover the pixel fully, and
        // less blurred surfaces cover it partially.
        float diameter = 2.0 * float(reduction) * textureLod(nearRadii, place, 0.0).r;
        weight /= max(clamp(diameter, 0.0, 1.0) * min(diameter * perNearDiameter, 1.0), 1e-6);
    }
    return clamp(weight, 0.0, 1.0);
}

// Returns the factor by which the near field's coverage is multiplied before compositing. `before` is the radiance of
// the near field, and `behind` the radiance of the image behind it.
float biasOf(float coverage, vec3 before, vec3 behind) {
    if (!biasByLuminance) return blendBias;
    // The factor is close to blendBias where a near field much brighter than the background covers most of the pixel,
    // because the sharp image would show through there. It is close to 1 elsewhere.
    const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
    float near = dot(before, luminance);
    return 1.0 + (blendBias - 1.0) * coverage * near / max(near + dot(behind, luminance), 1e-12);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float diameter = pinholeCircleOfConfusion(pixel, 0);
    vec3 sharp = clearColor(pixel);
    vec2 place = gl_FragCoord.xy / (float(reduction) * vec2(textureSize(farBlurred, 0)));
    vec4 behind = textureLod(farBlurred, place, 0.0);
    float own = clamp(diameter, 0.0, 1.0) * min(diameter * perFarDiameter, 1.0);
    // The far field fades in as the blur diameter grows from 1 to 2 field pixels.
    float farShare = clamp(diameter / float(reduction) - 1.0, 0.0, 1.0);
    vec3 color = mix(sharp, radianceOf(behind, own, sharp), farShare);
    vec4 before = textureLod(nearBlurred, place, 0.0);
    float coverage = coverageOf(before.a, place);
    if (blendBias > 0.0 && coverage > 0.0) {
        vec3 near = max(before.rgb, vec3(0.0)) / max(before.a, 1e-12);
        color = mix(color, near, clamp(coverage * biasOf(coverage, near, color), 0.0, 1.0));
    }
    image = vec4(color, 1.0);
    if (bracketed) image = inTenBits(image);
}
