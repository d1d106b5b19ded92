// Rounds an image to half floats. Radiance above the range of half floats is clamped.

layout(binding = 0) uniform sampler2D image;

layout(location = 0) out vec4 kept;

void main() {
    const float maxHalf = 65504.0;
    kept = clamp(texelFetch(image, ivec2(gl_FragCoord.xy), 0), -maxHalf, maxHalf);
}
