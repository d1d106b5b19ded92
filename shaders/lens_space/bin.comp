// Kernel 2 of the lens-space methods: finds the tiles that a triangle may cover as seen from any lens point at any
// time. With countsOnly, counts the triangles of each tile; otherwise fills the tiles' triangle lists.

#include "include/frame.glsl"
#include "lens_space/triangles.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = 3) readonly buffer DrawBlock { Draw draws[]; };
// With countsOnly, the number of triangles of each tile. Otherwise, the index in `entries` of each tile's next free
// entry.
layout(std430, binding = 4) buffer CountBlock { uint counts[]; };
#ifdef COUNTS_ONLY
void addEntry(uint tile, uint triangle) { atomicAdd(counts[tile], 1u); }
#else
layout(std430, binding = 5) writeonly buffer EntryBlock { uint entries[]; };
void addEntry(uint tile, uint triangle) { entries[atomicAdd(counts[tile], 1u)] = triangle; }
#endif

layout(location = 0) uniform ivec2 imageSize;
layout(location = 1) uniform uint triangleCount;
layout(location = 2) uniform uint firstTile;   // tiles [firstTile, endTile), in rows from the lower left
layout(location = 3) uniform uint endTile;

struct Area {
    vec2 minimum;   // normalised device coordinates
    vec2 maximum;
};

void add(inout Area area, vec4 clip, float aspect) {
    vec2 place = clip.xy / clip.z;
    vec2 reach = abs(clip.w / clip.z) * vec2(1.0, aspect);
    area.minimum = min(area.minimum, place - reach);
    area.maximum = max(area.maximum, place + reach);
}

// Extends the area by the part of the triangle beyond the near plane, as seen from all lens points. C/w and the image
// position are monotonic along an edge, so the corners of this part bound the area.
void add(inout Area area, vec4 corners[3], float aspect) {
    float near = frame.projection.z;
    for (int i = 0; i < 3; ++i) {
        vec4 p = corners[i];
        vec4 q = corners[(i + 1) % 3];
        if (p.z >= near) add(area, p, aspect);
        if ((p.z >= near) != (q.z >= near)) {
            vec4 cut = mix(p, q, (near - p.z) / (q.z - p.z));
            cut.z = near;
            add(area, cut, aspect);
        }
    }
}

// Returns true if the entire lens sees the triangle's back (Munkberg, Toth and Akenine-Möller 2012, Appendix A). A
// margin covers rounding errors.
bool facesAway(vec4 p[3], float aspect) {
    vec3 n0 = cross(p[1].xyz, p[2].xyz);
    vec3 n1 = cross(p[2].xyz, p[0].xyz);
    vec3 n2 = cross(p[0].xyz, p[1].xyz);
    vec3 a = abs(p[0].xyz);
    vec3 b = abs(p[1].xyz);
    vec3 c = abs(p[2].xyz);
    float size = dot(a, b.yzx * c.zxy + b.zxy * c.yzx);
    vec2 slope = p[0].w * n0.xy + p[1].w * n1.xy + p[2].w * n2.xy;
    return dot(p[0].xyz, n0) + length(slope * vec2(1.0, aspect)) < -1e-6 * size;
}

void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= triangleCount) return;
    uvec4 triangle = triangles[index];
    float aspect = float(imageSize.x) / float(imageSize.y);
    vec4 corners[3] = vec4[3](clips[triangle.x], clips[triangle.y], clips[triangle.z]);
    Area area = Area(vec2(1e30), vec2(-1e30));
    add(area, corners, aspect);
    if (moving) {
        // While a vertex moves in front of the camera, its image position and C/w stay between their values at the
        // start and the end. No such bound exists if a corner crosses the near plane.
        vec4 later[3] = vec4[3](clipAtEnd(triangle.x), clipAtEnd(triangle.y), clipAtEnd(triangle.z));
        float near = frame.projection.z;
        float minimum = min(min(min(corners[0].z, corners[1].z), corners[2].z), min(min(later[0].z, later[1].z), later[2].z));
        float maximum = max(max(max(corners[0].z, corners[1].z), corners[2].z), max(max(later[0].z, later[1].z), later[2].z));
        if (maximum < near) return;
        add(area, later, aspect);
        if (minimum < near) area = Area(vec2(-1.0), vec2(1.0));
    } else {
        if (area.minimum.x > area.maximum.x) return;
        if (draws[triangle.w].doubleSided == 0u && facesAway(corners, aspect)) return;
    }
    // A margin of 0.001 px covers rounding errors.
    vec2 size = vec2(imageSize);
    vec2 first = floor(clamp((area.minimum * 0.5 + 0.5) * size - 1e-3, vec2(-1.0), size) / float(tileSize));
    vec2 last = floor(clamp((area.maximum * 0.5 + 0.5) * size + 1e-3, vec2(-1.0), size - 0.5) / float(tileSize));
    ivec2 from = max(ivec2(first), ivec2(0));
    ivec2 to = ivec2(last);
    int across = (imageSize.x + tileSize - 1) / tileSize;
    from.y = max(from.y, int(firstTile) / across);
    to.y = min(to.y, int(endTile - 1u) / across);
    for (int y = from.y; y <= to.y; ++y) {
        for (int x = from.x; x <= to.x; ++x) {
            uint tile = uint(y * across + x);
            if (tile < firstTile || tile >= endTile) continue;
            addEntry(tile, index);
        }
    }
}
