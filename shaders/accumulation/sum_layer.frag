// Adds a batch (wave) of samples of a data layer (depth, normal, …) to the layer's compensated sum, one sample after
// another, so that the sum does not depend on the number of samples per batch. The samples have the same weights as in
// the image, except that wavelengths do not change the weights.
#include "accumulation/layer_light.glsl"

layout(rgba32f, binding = 0) uniform restrict image2D sumImage;
layout(rgba32f, binding = 1) uniform restrict image2D compensationImage;
layout(LAYER_FORMAT, binding = 2) uniform restrict readonly image2DArray drawn;   // one array layer per sample
layout(location = 3) uniform bool startsFrame;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = startsFrame ? vec4(0.0) : imageLoad(sumImage, pixel);
    vec4 compensation = startsFrame ? vec4(0.0) : imageLoad(compensationImage, pixel);
    vec2 rim = barrelRim(pixelOnImagePlane());
    float nearest = startsFrame ? uintBitsToFloat(0x7f800000u) : sum.a;
    float seen = compensation.a;
    for (int layer = 0; layer < waveSamples; ++layer) {
        if (catEye > 0.0 && isClipped(layer, rim)) continue;
        seen += 1.0;
        vec4 value = imageLoad(drawn, ivec3(pixel, layer));
        if (keepsNearest && value.g > 0.0) nearest = min(nearest, value.r / value.g);
        addCompensated(sum.rgb, compensation.rgb, value.rgb);
        if (sumsAlpha) addCompensated(sum.a, compensation.a, value.a);
    }
    // In the depth layer, alpha is the second component. The fourth component of `sum` therefore holds the nearest
    // depth, and that of `compensation` the number of samples.
    if (keepsNearest) {
        sum.a = nearest;
        compensation.a = seen;
    }
    imageStore(sumImage, pixel, sum);
    imageStore(compensationImage, pixel, compensation);
}
