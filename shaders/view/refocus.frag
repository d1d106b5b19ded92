// Computes the mean of lens images, each moved by whole pixels (src/refocus/refocus.h).

layout(binding = 0) uniform sampler2DArray images;
layout(location = 0) uniform int imageCount;
// For each lens image, xy: the texel that is added to pixel (0, 0) of the mean; z: the image's layer in `images`.
layout(location = 1) uniform ivec3 moves[blockSamples];

layout(location = 0) out vec4 mean;

void main() {
    ivec3 pixel = ivec3(gl_FragCoord.xy, 0);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < imageCount; ++i) sum += texelFetch(images, pixel + moves[i], 0);
    mean = sum / float(imageCount);
}
