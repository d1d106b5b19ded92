// Kernel 3 of the method "stochastic": finds the first hit of each ray of a tile's pixels. A workgroup processes one
// tile and one ray of each of the tile's pixels. These rays pass through a small part of the lens. The rays are tested
// only against the triangles that may be visible in the tile from this part (Munkberg, Toth and Akenine-Möller 2012,
// Section 4: tile tests with bounds of u and v).

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "lens_space/triangles.glsl"
#include "lens_space/rays.glsl"
#include "lens_space/records.glsl"

layout(local_size_x = tileSize, local_size_y = tileSize) in;

layout(std430, binding = 3) readonly buffer DrawBlock { Draw draws[]; };
// End of each tile's triangle list, as an index into `entries`.
layout(std430, binding = 4) readonly buffer TileBlock { uint tileEnds[]; };
layout(std430, binding = 5) readonly buffer EntryBlock { uint entries[]; };
// For each ray index, the bounding box of the lens points of the rays with this index in all ray sets (rays.glsl). xy:
// min (u, k·v); zw: max (u, k·v); k: the image's aspect ratio.
layout(std140, binding = 7) uniform BoundBlock { vec4 lensBounds[maxRays]; };

// Counter of tests, each of one triangle against all rays of a workgroup; 64-bit, low word first.
layout(std430, binding = 8) buffer TestBlock { uint tests[2]; };

layout(location = 2) uniform uint firstTile;   // first tile whose triangle list is in `entries`
// This dispatch tests the entries x to y - 1 of each tile's list. Mesa's software driver ends the loops of a thread
// after a total of 65,535 iterations. Long lists therefore need several dispatches, each of which continues where the
// previous dispatch ended.
layout(location = 3) uniform uvec2 part;

const uint threads = uint(tileSize * tileSize);
const uint stride = moving ? 6u : 3u;
shared vec4 keptCorners[threads * stride];
shared uvec2 kept[threads];   // triangles that the tile's rays may hit; x: index, y: 1 if double-sided, else 0
shared uint keptCount;
shared uint open;             // 1 if any ray of the workgroup may still hit a later triangle of the list, else 0

// Extends the bounds (normalised device coordinates) by the image positions of a vertex as seen from all lens points in
// the box `lens`.
void addPlaces(inout vec2 minimum, inout vec2 maximum, vec4 clip, vec4 lens) {
    vec2 shear = vec2(clip.w) / clip.z;
    vec2 place = clip.xy / clip.z;
    vec2 a = place + shear * lens.xy;
    vec2 b = place + shear * lens.zw;
    vec2 reach = aberrations ? aberrationReach(place) : vec2(0.0);
    minimum = min(minimum, min(a, b) - reach);
    maximum = max(maximum, max(a, b) + reach);
}

bool mayCover(vec4 corners[stride], vec4 lens, vec2 tileMin, vec2 tileMax) {
    vec2 minimum = vec2(1e30);
    vec2 maximum = vec2(-1e30);
    for (uint i = 0u; i < stride; ++i) {
        if (corners[i].z < frame.projection.z) return true;
        addPlaces(minimum, maximum, corners[i], lens);
    }
    return all(lessThanEqual(minimum, tileMax)) && all(greaterThanEqual(maximum, tileMin));
}

void main() {
    uint tile = firstTile + gl_WorkGroupID.x;
    uint ray = gl_WorkGroupID.y;
    uint across = uint(imageSize.x + tileSize - 1) / uint(tileSize);
    uvec2 corner = uvec2(tile % across, tile / across) * uint(tileSize);
    uvec2 pixel = corner + gl_LocalInvocationID.xy;
    Ray mine = rayOf(ray, pixel);
    vec2 place = placeOf(mine, pixel);
    vec2 lens = mine.lensAndPixel.xy;
    vec2 margin = vec2(2e-3) / vec2(imageSize);   // 0.001 px
    vec2 tileMin = 2.0 * vec2(corner) / vec2(imageSize) - 1.0 - margin;
    vec2 tileMax = 2.0 * vec2(corner + uint(tileSize)) / vec2(imageSize) - 1.0 + margin;

    uint end = tileEnds[tile];
    uint first = gl_WorkGroupID.x == 0u ? 0u : tileEnds[tile - 1u];
    if (part.x > 0u && part.x >= end - first) return;
    end = min(end, first + part.y);
    first += part.x;
    bool inside = all(lessThan(pixel, uvec2(imageSize)));
    uint index = (ray * uint(imageSize.y) + pixel.y) * uint(imageSize.x) + pixel.x;
    float nearest = 3e38;
    uint triangle = noTriangle;
    if (part.x > 0u && inside && records[index].triangle != noTriangle) {
        nearest = records[index].place;
        triangle = records[index].triangle;
    }
    for (uint base = first; base < end; base += threads) {
        if (gl_LocalInvocationIndex == 0u) {
            keptCount = 0u;
            open = 0u;
        }
        barrier();
        // Triangles are sorted by min depth, so a ray is done once its hit is nearer than the next triangle.
        if (inside && nearest * (1.0 + 1e-5) >= minDepthOf(triangles[entries[base]].xyz)) atomicOr(open, 1u);
        barrier();
        if (open == 0u) break;
        uint at = base + gl_LocalInvocationIndex;
        if (at < end) {
            uint candidate = entries[at];
            uvec4 vertices = triangles[candidate];
            Draw draw = draws[vertices.w];
            vec4 corners[stride];
            for (int i = 0; i < 3; ++i) corners[i] = clips[vertices[i]];
            if (moving)
                for (uint i = 3u; i < stride; ++i) corners[i] = clipAtEnd(vertices[i - 3u]);
            if (firstRay + ray >= draw.firstRay && firstRay + ray < draw.endRay &&
                mayCover(corners, lensBounds[ray], tileMin, tileMax)) {
                uint slot = atomicAdd(keptCount, 1u);
                kept[slot] = uvec2(candidate, draw.doubleSided);
                for (uint i = 0u; i < stride; ++i) keptCorners[slot * stride + i] = corners[i];
            }
        }
        barrier();
        if (gl_LocalInvocationIndex == 0u && keptCount > 0u) {
            uint before = atomicAdd(tests[0], keptCount);
            if (before + keptCount < before) atomicAdd(tests[1], 1u);
        }
        for (uint i = 0u; i < keptCount; ++i) {
            uint slot = i * stride;
            vec4 corners[3] = vec4[3](keptCorners[slot], keptCorners[slot + 1u], keptCorners[slot + 2u]);
            if (moving)
                for (uint k = 0u; k < 3u; ++k) corners[k] = mix(corners[k], keptCorners[slot + k + 3u], mine.values.x);
            float w = depthMet(corners[0], corners[1], corners[2], kept[i].y != 0u, lens, place);
            // At equal depth the triangle with the smaller index wins, so that the result is deterministic.
            if (w > 0.0 && (w < nearest || (w == nearest && kept[i].x < triangle))) {
                nearest = w;
                triangle = kept[i].x;
            }
        }
        barrier();
    }
    if (inside) records[index] = Record(triangle, index, nearest, 1.0);
}
