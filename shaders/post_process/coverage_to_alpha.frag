// Copies the coverage, which was blurred as an image of its own, to the alpha channel of the blurred radiance.
layout(binding = 0) uniform sampler2D coverage;

layout(location = 0) out vec4 alpha;

void main() { alpha = vec4(clamp(texelFetch(coverage, ivec2(gl_FragCoord.xy), 0).r, 0.0, 1.0)); }
