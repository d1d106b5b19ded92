// Kernel 3 of the line samples: what each line of a tile's pixels sees along its way over the lens. A group of threads has one tile and
// one line of each of its pixels.
//
// EXACT: each line keeps what is visible so far, in pieces that don't overlap, and cuts every further segment at their ends and where
// the two intersect. Otherwise segments are kept in a buffer in shared memory, as published, and resolved in the end.

#include "include/frame.glsl"
#include "lens_space/triangles.glsl"
#include "lens_space/rays.glsl"
#include "lens_space/records.glsl"
#include "line/line.glsl"
#include "line/weights.glsl"

layout(local_size_x = TILE, local_size_y = TILE) in;

layout(std430, binding = 3) readonly buffer DrawBlock { Draw draws[]; };
layout(std430, binding = 4) readonly buffer TileBlock { uint tileEnds[]; };   // of each tile's triangles among the entries
layout(std430, binding = 5) readonly buffer EntryBlock { uint entries[]; };
layout(std430, binding = 1) buffer OutputBlock {
    uint recordCount;       // asked for
    uint droppedSegments;
    uint droppedLight;      // in 1/1024 of a line
    uint mergedSegments;
    uint unfinished;        // threads whose loops the driver ended
    uint unused;
    uvec2 ranges[];         // of each ray: its first record, their number
};
struct Bounds {
    vec4 box;               // of the line over the variants: least u, k·v, most
    vec4 strip;             // xy: across the line, a unit vector in (u, v); z: how far any variant leaves the middle along it
};
layout(std140, binding = 7) uniform BoundBlock { Bounds lensBounds[MOST_RAYS]; };

layout(location = 2) uniform uint firstTile;       // of those that the entries hold
layout(location = 3) uniform uint recordCapacity;
layout(location = 5) uniform float shadingStep;    // px that a surface moves under one shading point; 0: one for each segment

const uint threads = uint(TILE * TILE);
shared vec4 keptCorners[threads * 3u];
shared uvec2 kept[threads];   // triangle, double-sided
shared uint keptHere[threads];   // whether the thread's candidate is kept
shared uint keptCount;

#ifdef EXACT
#include "line/envelope.glsl"
#else
#include "line/segment_buffer.glsl"
#endif

bool mayCover(vec4 corners[3], Bounds bounds, vec2 tileLeast, vec2 tileMost) {
    vec2 least = vec2(1e30);
    vec2 most = vec2(-1e30);
    float aspect = float(imageSize.x) / float(imageSize.y);
    vec2 across = bounds.strip.xy * vec2(1.0, 1.0 / aspect);
    vec2 range = vec2(1e30, -1e30);
    for (uint i = 0u; i < 3u; ++i) {
        if (corners[i].z < frame.projection.z) return true;
        float blur = corners[i].w / corners[i].z;
        vec2 place = corners[i].xy / corners[i].z;
        vec2 a = place + blur * bounds.box.xy;
        vec2 b = place + blur * bounds.box.zw;
        least = min(least, min(a, b));
        most = max(most, max(a, b));
        float leaves = abs(blur) * bounds.strip.z;
        range = vec2(min(range.x, dot(place, across) - leaves), max(range.y, dot(place, across) + leaves));
    }
    if (any(greaterThan(least, tileMost)) || any(lessThan(most, tileLeast))) return false;
    vec2 middle = 0.5 * (tileLeast + tileMost);
    float reach = dot(0.5 * (tileMost - tileLeast), abs(across));
    return range.x <= dot(middle, across) + reach && range.y >= dot(middle, across) - reach;
}

// How many shading points a visible piece gets: one for each step that its surface moves in the image.
uint shadingPoints(uint triangle, float p1, float p2, vec2 direction) {
    if (shadingStep == 0.0) return 1u;
    float blur = 0.0;   // C/w
    if (triangle == noTriangle) {
#if BACKGROUND == 3
        blur = frame.coc.w;   // other skies change too slowly to need more than one point
#endif
    } else {
        uvec4 vertices = triangles[triangle];
        for (int i = 0; i < 3; ++i) {
            vec4 clip = clips[vertices[i]];
            blur = max(blur, abs(clip.w) / max(clip.z, frame.projection.z));
        }
    }
    float way = 0.5 * abs(blur) * (p2 - p1) * length(direction * vec2(imageSize));   // px
    return uint(clamp(ceil(way / shadingStep), 1.0, float(MOST_SHADING_POINTS)));
}

uint recordsOf(uint triangle, float p1, float p2, vec2 direction) { return p2 > p1 ? shadingPoints(triangle, p1, p2, direction) : 0u; }

uint writeRecords(uint at, uint ray, uint triangle, float p1, float p2, Ray mine) {
    uint count = recordsOf(triangle, p1, p2, mine.lensAndPixel.xy);
    vec2 sides = mine.values.xy;
    for (uint i = 0u; i < count; ++i) {
        float from = i == 0u ? p1 : placeOfShare(p1, p2, float(i) / float(count));
        float to = i + 1u == count ? p2 : placeOfShare(p1, p2, float(i + 1u) / float(count));
        // As published: in the middle. Otherwise anywhere, so that what varies along a segment is right on average.
        float place = shadingStep == 0.0 ? 0.5 * (from + to) : placeOfShare(from, to, mine.values.z);
        records[at + i] = Record(triangle, ray, place, lightBetween(from, to, sides));
    }
    return count;
}

void main() {
    uint tile = firstTile + gl_WorkGroupID.x;
    uint ray = gl_WorkGroupID.y;
    uint across = uint(imageSize.x + TILE - 1) / uint(TILE);
    uvec2 corner = uvec2(tile % across, tile / across) * uint(TILE);
    uvec2 pixel = corner + gl_LocalInvocationID.xy;
    Ray mine = rayOf(ray, pixel);
    vec2 place = placeOf(mine, pixel);
    vec2 direction = mine.lensAndPixel.xy;
    Interval whole = Interval(-mine.values.x, 1.0);
    vec2 margin = vec2(2e-3) / vec2(imageSize);   // a thousandth of a pixel
    vec2 tileLeast = 2.0 * vec2(corner) / vec2(imageSize) - 1.0 - margin;
    vec2 tileMost = 2.0 * vec2(corner + uint(TILE)) / vec2(imageSize) - 1.0 + margin;

    beginLine(mine.values.xy);
    uint asked = 0u;   // triangles to be held against the line, and those that were
    uint done = 0u;
    uint seenBatches = 0u;
    uint end = tileEnds[tile];
    uint first = gl_WorkGroupID.x == 0u ? 0u : tileEnds[tile - 1u];
    for (uint base = first; base < end; base += threads) {
        ++seenBatches;
        keptHere[gl_LocalInvocationIndex] = 0u;
        uint at = base + gl_LocalInvocationIndex;
        uvec4 vertices = uvec4(0u);
        vec4 corners[3];
        Draw draw;
        if (at < end) {
            vertices = triangles[entries[at]];
            draw = draws[vertices.w];
            for (int i = 0; i < 3; ++i) corners[i] = clips[vertices[i]];
            if (firstRay + ray >= draw.firstRay && firstRay + ray < draw.endRay &&
                mayCover(corners, lensBounds[ray], tileLeast, tileMost))
                keptHere[gl_LocalInvocationIndex] = 1u;
        }
        // In the order of the list, whatever the threads' order: which segments a full buffer drops depends on it.
        barrier();
        uint before = 0u;
        for (uint i = 0u; i < gl_LocalInvocationIndex; ++i) before += keptHere[i];
        if (keptHere[gl_LocalInvocationIndex] != 0u) {
            kept[before] = uvec2(entries[at], draw.doubleSided);
            for (uint i = 0u; i < 3u; ++i) keptCorners[before * 3u + i] = corners[i];
        }
        if (gl_LocalInvocationIndex == threads - 1u) keptCount = before + keptHere[gl_LocalInvocationIndex];
        barrier();
        asked += keptCount;
        for (uint i = 0u; i < keptCount; ++i) {
            ++done;
            OnLine line = onLine(keptCorners[3u * i], keptCorners[3u * i + 1u], keptCorners[3u * i + 2u], direction, place);
            Interval interval = seen(line, whole);
            if (interval.last > interval.first) addSegment(interval, kept[i].x, line);
            if (kept[i].y != 0u) {
                line = turned(line);
                interval = seen(line, whole);
                if (interval.last > interval.first) addSegment(interval, kept[i].x, line);
            }
        }
        barrier();
    }
    if (any(greaterThanEqual(pixel, uvec2(imageSize)))) return;
    uint index = (ray * uint(imageSize.y) + pixel.y) * uint(imageSize.x) + pixel.x;

    // Twice the same walk along the line: to count the records, then to write them.
    uint needed = 0u;
    for (Piece piece = firstPiece(whole); piece.last > piece.first; piece = nextPiece(piece, whole))
        needed += recordsOf(piece.triangle, piece.first, piece.last, direction);
    uint at = atomicAdd(recordCount, needed);
    ranges[index] = uvec2(at, needed);
    countDropped();
    uint batches = end > first ? (end - first - 1u) / threads + 1u : 0u;
    if (done != asked || seenBatches != batches) atomicAdd(unfinished, 1u);
    if (at + needed > recordCapacity) return;   // the wave is drawn again with room for all
    for (Piece piece = firstPiece(whole); piece.last > piece.first; piece = nextPiece(piece, whole))
        at += writeRecords(at, index, piece.triangle, piece.first, piece.last, mine);
}
