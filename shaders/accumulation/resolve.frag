// Divides the frame's compensated sum by the frame's number of samples. If this number differs between pixels, divides
// by the pixel's number of samples, which is stored in alpha.
layout(binding = 0) uniform sampler2D frameSum;
layout(binding = 1) uniform sampler2D frameCompensation;
layout(location = 0) uniform float sampleCount;   // number of samples in the sum; 0: divide by alpha

layout(location = 0) out vec4 mean;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(frameSum, pixel, 0) + texelFetch(frameCompensation, pixel, 0);
    mean = sampleCount > 0.0 ? sum / sampleCount : vec4(sum.rgb / max(sum.a, 1.0), 1.0);
}
