// Finds the next hit of rays that pass through a cut-out or blended surface. The records (ray hits) of such rays have a
// negative weight. The next hit is the nearest behind the record's triangle. If that hit is opaque or the sky, the
// weight becomes positive again.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "lens_space/triangles.glsl"
#include "lens_space/rays.glsl"
#include "lens_space/records.glsl"
#include "lens_space/record_rays.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = 3) readonly buffer DrawBlock { Draw draws[]; };
// End of each tile's triangle list, as an index into `entries`.
layout(std430, binding = 4) readonly buffer TileBlock { uint tileEnds[]; };
layout(std430, binding = 5) readonly buffer EntryBlock { uint entries[]; };

layout(location = 2) uniform uint recordCount;
layout(location = 3) uniform uvec2 tiles;   // `entries` has the triangle lists of the tiles from tiles.x to tiles.y − 1

// Variables of the current ray. They are initialised because drivers warn about uninitialised values.
vec2 lens = vec2(0.0);
vec2 place = vec2(0.0);
float time = 0.0;
uint number = 0u;
float behindDepth = 0.0;   // depth w of the ray's latest hit; only hits behind it are searched for
uint behindTriangle = noTriangle;
float nearest = 3e38;
uint triangle = noTriangle;

// At equal depth, triangles are hit in the order of their indices.
bool comesAfter(float w, uint candidate) { return w > behindDepth || (w == behindDepth && candidate > behindTriangle); }
bool comesBefore(float w, uint candidate) { return w < nearest || (w == nearest && candidate < triangle); }

void test(uint candidate) {
    uvec4 vertices = triangles[candidate];
    Draw draw = draws[vertices.w];
    if (number < draw.firstRay || number >= draw.endRay) return;
    float w = depthMet(clipAt(vertices.x, time), clipAt(vertices.y, time), clipAt(vertices.z, time), draw.doubleSided != 0u, lens, place);
    if (w > 0.0 && comesAfter(w, candidate) && comesBefore(w, candidate)) {
        nearest = w;
        triangle = candidate;
    }
}

void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= recordCount) return;
    Record record = records[index];
    if (record.weight >= 0.0) return;
    uvec2 pixel = pixelOf(record);
    uint across = uint(imageSize.x + tileSize - 1) / uint(tileSize);
    uint tile = pixel.y / uint(tileSize) * across + pixel.x / uint(tileSize);
    if (tile < tiles.x || tile >= tiles.y) return;
    Ray ray = rayOf(numberOf(record), pixel);
    lens = lensPointOf(record, ray);
    place = placeOf(ray, pixel);
    time = ray.values.x;
    number = firstRay + numberOf(record);
    behindTriangle = record.triangle;
    uvec3 vertices = triangles[behindTriangle].xyz;
    vec4 a = clipAt(vertices.x, time);
    vec4 b = clipAt(vertices.y, time);
    vec4 c = clipAt(vertices.z, time);
    behindDepth = depthOnPlane(edgeFunctions(a, b, c, lens, place), a, b, c);

    // Mesa's software driver ends the loops of a thread after a total of 65,535 iterations, so each iteration tests
    // entriesAtOnce triangles (see_through.cpp).
    uint end = tileEnds[tile];
    for (uint at = tile == tiles.x ? 0u : tileEnds[tile - 1u]; at < end; at += 8u) {
        // Triangles are sorted by min depth, so all remaining triangles are behind the nearest hit.
        if (nearest * (1.0 + 1e-5) < minDepthOf(triangles[entries[at]].xyz)) break;
        test(entries[at]);
        if (at + 1u < end) test(entries[at + 1u]);
        if (at + 2u < end) test(entries[at + 2u]);
        if (at + 3u < end) test(entries[at + 3u]);
        if (at + 4u < end) test(entries[at + 4u]);
        if (at + 5u < end) test(entries[at + 5u]);
        if (at + 6u < end) test(entries[at + 6u]);
        if (at + 7u < end) test(entries[at + 7u]);
    }
    records[index].triangle = triangle;
    if (!lineSamples) records[index].place = nearest;
    if (triangle == noTriangle || draws[triangles[triangle].w].seeThrough == 0u) records[index].weight = -record.weight;
}
