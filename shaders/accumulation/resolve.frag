// The frame's sum over its number of samples.
layout(binding = 0) uniform sampler2D frameSum;
layout(binding = 1) uniform sampler2D frameCompensation;
layout(location = 0) uniform float sampleCount;

layout(location = 0) out vec4 mean;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    mean = (texelFetch(frameSum, pixel, 0) + texelFetch(frameCompensation, pixel, 0)) / sampleCount;
}
