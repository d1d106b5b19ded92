// Computes where the records (ray hits) of each group of surfaces with the same shader begin in the list of records,
// and how many workgroups of 256 threads shade them.

#include "lens_space/groups.glsl"

layout(local_size_x = 1) in;

layout(std430, binding = 4) buffer GroupBlock { Group groups[]; };
// number of workgroups in x, y, z that shade each group of surfaces
layout(std430, binding = 6) writeonly buffer DispatchBlock { uint sizes[]; };

layout(location = 0) uniform uint groupCount;

void main() {
    uint first = 0u;
    for (uint i = 0u; i < groupCount; ++i) {
        uint count = groups[i].count;
        groups[i].first = first;
        first += count;
        uint needed = (count + 255u) / 256u;
        sizes[3u * i] = min(needed, 65535u);
        sizes[3u * i + 1u] = needed == 0u ? 0u : (needed + 65534u) / 65535u;
        sizes[3u * i + 2u] = 1u;
    }
}
