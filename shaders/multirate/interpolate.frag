// The sum of a block's layers with pixels PIXEL_RATE times larger, where nothing else is seen: as sums are linear, interpolating theirs once is
// interpolating each layer.

layout(binding = 0) uniform sampler2D smallSum;
layout(binding = 1) uniform sampler2D smallCompensation;

layout(location = 0) out vec4 sumOut;
layout(location = 1) out vec4 compensationOut;

#include "include/large_pixels.glsl"

void main() {
    LargePixels around = largePixels(ivec2(gl_FragCoord.xy), float(PIXEL_RATE));
    sumOut = vec4(0.0);
    compensationOut = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = around.texel + ivec2(i & 1, i >> 1);
        sumOut += around.weights[i] * texelFetch(smallSum, texel, 0);
        compensationOut += around.weights[i] * texelFetch(smallCompensation, texel, 0);
    }
}
