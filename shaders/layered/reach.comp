// Computes, for each pixel and layer, the min and max signed blur (px) of all surfaces that the pixel's lens rays may
// meet. A ray meets a surface at most half the surface's blur away from the pixel. The shader bounds the blur by the
// surfaces in a square around the pixel. A smaller bound permits a smaller square, which may give a smaller bound, so
// the computation is repeated.
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2DArray extents;   // pyramid of min and max blur from layered/extent.comp
layout(binding = 0, rg32f) writeonly uniform image2DArray reachOut;
layout(location = 0) uniform int border;        // border in px by which the layers extend beyond the image
layout(location = 1) uniform float farthest;    // max distance (px) of a pixel from surfaces that its rays can meet
layout(location = 2) uniform float bandBlur;    // max change of the blur due to the wavelength (px)

const int maxRounds = 5;

vec2 extentAround(vec2 centre, float radius, int layer) {
    int level = clamp(int(ceil(log2(max(radius, 2.0)))) - 1, 0, extentLevels - 1);
    float size = float(2 << level);
    ivec2 first = max(ivec2(floor((centre - radius) / size)), ivec2(0));
    // The level's size is computed, because some drivers cannot query the size of a level that differs between threads.
    ivec2 last = min(ivec2(floor((centre + radius) / size)), (textureSize(extents, 0).xy >> level) - 1);
    vec2 extent = vec2(1e30, -1e30);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            vec2 part = texelFetch(extents, ivec3(x, y, layer), level).xy;
            extent = vec2(min(extent.x, part.x), max(extent.y, part.y));
        }
    return extent;
}

void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(reachOut)))) return;
    vec2 centre = vec2(at.xy + border) + 0.5;
    float radius = farthest;
    vec2 reach = vec2(0.0);
    for (int i = 0; i < maxRounds; ++i) {
        reach = extentAround(centre, radius, at.z);
        if (reach.x > reach.y) break;
        float smaller = 0.5 * (max(abs(reach.x), abs(reach.y)) + bandBlur) + 1.0;
        if (smaller > 0.9 * radius) break;
        radius = smaller;
    }
    imageStore(reachOut, at, vec4(reach, 0.0, 0.0));
}
