// Computes one level of a pyramid of the min and max signed blur (px) of each layer's surfaces. A texel of level l
// covers a square of 2^(l + 1) pixels per side. Without a surface, min > max.
layout(local_size_x = 8, local_size_y = 8) in;

// Input. With finestExtents: the surfaces from layered/peel.frag (surfaceOut). Otherwise: the pyramid that this shader
// builds, of which level `finer` is read.
layout(binding = 0) uniform sampler2DArray source;
layout(location = 0) uniform int finer;              // pyramid level to read from `source`
layout(binding = 0, rg32f) writeonly uniform image2DArray extentOut;

vec2 extentOf(ivec3 texel) {
    if (!finestExtents) return texelFetch(source, texel, finer).xy;
    if (any(greaterThanEqual(texel.xy, textureSize(source, 0).xy))) return vec2(1e30, -1e30);
    vec4 surface = texelFetch(source, texel, 0);
    float inPixel = 0.5 * (abs(surface.y) + abs(surface.z));
    return surface.w < 0.0 ? vec2(1e30, -1e30) : vec2(surface.x - inPixel, surface.x + inPixel);
}

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel, imageSize(extentOut)))) return;
    vec2 extent = vec2(1e30, -1e30);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
            vec2 part = extentOf(ivec3(2 * texel.xy + ivec2(x, y), texel.z));
            extent = vec2(min(extent.x, part.x), max(extent.y, part.y));
        }
    imageStore(extentOut, texel, vec4(extent, 0.0, 0.0));
}
