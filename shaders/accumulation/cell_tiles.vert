// Draws point sprites over the tiles in which cell_means.frag must write the mean radiance of one blur class, a group
// of samples with similar blur (include/cells.glsl). These are the tiles where the mean is not 0, and their neighbours.
// All other point sprites are moved outside the image.
#include "include/cells.glsl"

layout(binding = 2) uniform usampler2D spreadClasses;
layout(location = 0) uniform int classIndex;
// Side in px of the squares over which the samples of the blur class are averaged.
layout(location = 1) uniform int side;
// Number of tiles along the side of a point sprite; > 1 for blur classes whose samples are averaged over large squares.
layout(location = 2) uniform int pointTiles;
layout(location = 3) uniform ivec2 points;

void main() {
    ivec2 point = ivec2(gl_VertexID % points.x, gl_VertexID / points.x);
    ivec2 last = textureSize(spreadClasses, 0) - 1;
    uint spread = 0u;
    for (int y = 0; y < pointTiles; ++y)
        for (int x = 0; x < pointTiles; ++x) spread |= texelFetch(spreadClasses, min(point * pointTiles + ivec2(x, y), last), 0).r;
    bool written = (spread >> besideSpread & 1u << classIndex) != 0u;
    gl_Position = vec4(written ? 2.0 * (vec2(point) + 0.5) / vec2(points) - 1.0 : vec2(2.0), 0.0, 1.0);
    gl_PointSize = float(pointTiles * cellTile / side);
}
