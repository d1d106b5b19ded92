// Composites a batch (wave) of lens samples, one layer per sample, over the environment. Adds the layers, in the order
// of the samples, to the compensated sum of the current block of samples.
#include "accumulation/layer_light.glsl"

layout(binding = 2) uniform sampler2D compensationSoFar;

layout(location = 0) out vec4 sumOut;
layout(location = 1) out vec4 compensationOut;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = startsBlock ? vec4(0.0) : texelFetch(sumSoFar, pixel, 0);
    vec4 compensation = startsBlock ? vec4(0.0) : texelFetch(compensationSoFar, pixel, 0);
    vec2 rim = barrelRim(pixelOnImagePlane());
    float seen = 0.0;
    for (int layer = 0; layer < layerCount; ++layer) {
        if (catEye > 0.0 && isClipped(layer, rim)) continue;
        seen += 1.0;
        vec4 light = layerLight(texelOf(0, layer));
        for (int position = 1; position < positions; ++position) light += layerLight(texelOf(position, layer));
        addLayer(sum, compensation, light / float(positions), layer);
    }
    // Alpha counts samples. Sums of integers are exact in floats, so alpha needs no compensation.
    if (backgroundType != 0) sum.a += catEye > 0.0 ? seen : float(layerCount);
    sumOut = sum;
    compensationOut = compensation;
}
