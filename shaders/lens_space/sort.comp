// Sorts each tile's triangles by min depth, so that rays can stop before they reach the hidden triangles at the end of
// the list. Triangles of equal depth are sorted by index, which makes the result deterministic. In this bitonic sort
// (Batcher 1968) the first step of each block is mirrored. All steps therefore put the smaller value first, and
// positions beyond the end of the list can be skipped.

layout(local_size_x = 256) in;

layout(std430, binding = 4) readonly buffer TileBlock { uint tileEnds[]; };
layout(std430, binding = 5) coherent buffer EntryBlock { uint entries[]; };

layout(std430, binding = 6) readonly buffer DepthBlock { uint depths[]; };

layout(location = 0) uniform uint firstTile;
// Size of the bitonic block and step that this dispatch runs; (0, 0) runs all of them. Mesa's software driver ends the
// loops of a thread after a total of 65,535 iterations, so long lists need one dispatch per step.
layout(location = 1) uniform uvec2 only;

void order(uint a, uint b) {
    uint p = entries[a];
    uint q = entries[b];
    uint depthP = depths[p];
    uint depthQ = depths[q];
    if (depthP < depthQ || (depthP == depthQ && p <= q)) return;
    entries[a] = q;
    entries[b] = p;
}

void main() {
    uint tile = firstTile + gl_WorkGroupID.x;
    uint first = gl_WorkGroupID.x == 0u ? 0u : tileEnds[tile - 1u];
    uint count = tileEnds[tile] - first;
    for (uint block = only.x > 0u ? only.x : 2u; (block >> 1u) < count; block <<= 1u) {
        for (uint step = only.x > 0u ? only.y : block >> 1u; step > 0u; step >>= 1u) {
            bool mirrored = step == block >> 1u;
            for (uint i = gl_LocalInvocationID.x; i < count; i += 256u) {
                uint partner = mirrored ? i ^ (block - 1u) : i ^ step;
                if (partner > i && partner < count) order(first + i, first + partner);
            }
            if (only.x > 0u) return;
            memoryBarrierBuffer();
            barrier();
        }
    }
}
