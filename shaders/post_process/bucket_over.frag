// Outputs the blurred, premultiplied image of a bucket (a group of alpha-blended objects of similar depth), for
// blending over the buckets behind.

layout(binding = 0) uniform sampler2D radiance;
layout(binding = 1) uniform sampler2D coverage;

layout(location = 0) out vec4 image;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    image = vec4(texelFetch(radiance, pixel, 0).rgb, clamp(texelFetch(coverage, pixel, 0).r, 0.0, 1.0));
}
