// Divides the sum of the radiance of a pixel's rays by their number.

layout(std430, binding = 3) readonly buffer SumBlock { vec4 sums[]; };

layout(location = 0) uniform int width;
layout(location = 1) uniform float rayCount;

layout(location = 0) out vec4 meanOut;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int at = 2 * (pixel.y * width + pixel.x);
    meanOut = (sums[at] + sums[at + 1]) / rayCount;
}
