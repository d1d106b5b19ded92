// Computes, for each tile, the max blur radius of the near surfaces whose disks reach this tile or a neighbouring tile.
// Disks spread beyond the edges of their surfaces.
layout(binding = 0) uniform sampler2D tiles;
// Max distance, in tiles, from which a blur disk can reach this tile or a neighbouring tile.
layout(location = 0) uniform int farthest;

layout(location = 0) out float reaching;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    ivec2 first = max(here - farthest, ivec2(0));
    ivec2 last = min(here + farthest, textureSize(tiles, 0) - 1);
    reaching = 0.0;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            float radius = texelFetch(tiles, ivec2(x, y), 0).r;
            vec2 gap = float(tileSize) * max(vec2(abs(ivec2(x, y) - here)) - 2.0, 0.0);
            if (radius > 0.0 && length(gap) <= radius) reaching = max(reaching, radius);
        }
}
