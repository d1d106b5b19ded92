// Blurs an image with the separable 3 × 3 filter of weights 1 2 1, an approximate Gaussian.
layout(binding = 0) uniform sampler2D small;

layout(location = 0) out vec4 blurred;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(small, 0) - 1;
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            sum += float((2 - abs(x)) * (2 - abs(y))) * texelFetch(small, clamp(pixel + ivec2(x, y), ivec2(0), last), 0);
    blurred = sum / 16.0;
}
