// Computes the radius within which a pixel gathers the near field: the max blur radius of its own surface and of all
// near surfaces whose disks may reach the pixel.
layout(binding = 0) uniform sampler2D ownRadii;
layout(binding = 1) uniform sampler2D reach;    // per tile: max radius of the near disks that reach it

layout(location = 0) out float radius;

void main() {
    vec2 place = gl_FragCoord.xy / (float(tileSize) * vec2(textureSize(reach, 0)));
    radius = max(texelFetch(ownRadii, ivec2(gl_FragCoord.xy), 0).r, textureLod(reach, place, 0.0).r);
}
