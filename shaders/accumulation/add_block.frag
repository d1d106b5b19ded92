// Adds the sum of a finished block of consecutive lens samples to the frame's compensated sum
// (include/compensated.glsl).
#include "include/compensated.glsl"

layout(binding = 0) uniform sampler2D blockSum;
layout(binding = 1) uniform sampler2D blockCompensation;
layout(binding = 2) uniform sampler2D frameSum;
layout(binding = 3) uniform sampler2D frameCompensation;
layout(location = 0) uniform bool startsFrame;

layout(location = 0) out vec4 sumOut;
layout(location = 1) out vec4 compensationOut;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = startsFrame ? vec4(0.0) : texelFetch(frameSum, pixel, 0);
    vec4 compensation = startsFrame ? vec4(0.0) : texelFetch(frameCompensation, pixel, 0);
    vec4 block = texelFetch(blockSum, pixel, 0);
    vec4 lost = texelFetch(blockCompensation, pixel, 0);
    addCompensated(sum.rgb, compensation.rgb, block.rgb);
    addCompensated(sum.rgb, compensation.rgb, lost.rgb);
    addCompensated(sum.a, compensation.a, block.a);
    addCompensated(sum.a, compensation.a, lost.a);
    sumOut = sum;
    compensationOut = compensation;
}
