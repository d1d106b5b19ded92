// Adds a data layer (depth, normal, …) of a wave's samples, one by one, to the layer's compensated sum, so that the sum
// does not depend on the number of samples per wave. The samples have the same weights as in the picture, but without the
// colours of their wavelengths.
#include "accumulation/layer_light.glsl"

layout(rgba32f, binding = 0) uniform restrict image2D sumImage;
layout(rgba32f, binding = 1) uniform restrict image2D compensationImage;
layout(location = 3) uniform bool startsFrame;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = startsFrame ? vec4(0.0) : imageLoad(sumImage, pixel);
    vec4 compensation = startsFrame ? vec4(0.0) : imageLoad(compensationImage, pixel);
    vec2 rim = barrelRim(pixelOnImagePlane());
    float nearest = startsFrame ? uintBitsToFloat(0x7f800000u) : sum.b;
    float seen = compensation.b;
    for (int layer = 0; layer < layerCount; ++layer) {
        if (catEye > 0.0 && isClipped(layer, rim)) continue;
        seen += 1.0;
        vec4 value = texelFetch(layers, ivec3(pixel, layer), 0);
        if (keepsNearest && value.a > 0.0) nearest = min(nearest, value.r / value.a);
        addCompensated(sum.rgb, compensation.rgb, value.rgb);
        addCompensated(sum.a, compensation.a, value.a);
    }
    // In the depth layer, the third component of the sum is the nearest depth, and the third component of the
    // compensation is the number of samples.
    if (keepsNearest) {
        sum.b = nearest;
        compensation.b = seen;
    }
    imageStore(sumImage, pixel, sum);
    imageStore(compensationImage, pixel, compensation);
}
