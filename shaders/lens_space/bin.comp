// Kernel 2 of the lens-space methods: finds the tiles that a triangle may cover as seen from any lens point at any
// time. With countsOnly, counts the triangles of each tile; otherwise fills the tiles' triangle lists.

#include "include/frame.glsl"
#include "include/lens.glsl"
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
    if (aberrations) reach += aberrationReach(place);
    area.minimum = min(area.minimum, place - reach);
    area.maximum = max(area.maximum, place + reach);
}

// Extends the area by the part of the triangle beyond the near plane, as seen from all lens points. The diameter of the
// circle of confusion and the image position are monotonic along an edge, so the corners of this part bound the area.
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

// Returns the polar form of the coefficients (Nx, Ny, det). The determinant of a triangle seen from the lens point
// (u, v) is det + u·Nx + k·v·Ny, with the aspect ratio k (src/plan/visible/visibility.h). The polar form is a function
// of three triangles that is linear in each of them. It equals (Nx, Ny, det) of a triangle if all three arguments are
// that triangle.
vec3 polarForm(vec4 a[3], vec4 b[3], vec4 c[3]) {
    vec2 slope = vec2(0.0);
    for (int i = 0; i < 3; ++i) slope += a[i].w * cross(b[(i + 1) % 3].xyz, c[(i + 2) % 3].xyz).xy;
    return vec3(slope, dot(a[0].xyz, cross(b[1].xyz, c[2].xyz)));
}

float overLens(vec3 coefficients, float aspect) { return coefficients.z + length(coefficients.xy * vec2(1.0, aspect)); }

// Returns an upper bound on the rounding error of a triangle's determinant.
float roundingOf(vec4 p[3]) {
    vec3 a = abs(p[0].xyz);
    vec3 b = abs(p[1].xyz);
    vec3 c = abs(p[2].xyz);
    return 1e-6 * dot(a, b.yzx * c.zxy + b.zxy * c.yzx);
}

// Returns true if the triangle's back is visible from the entire lens (Munkberg, Toth and Akenine-Möller 2012, Equation
// 5 and Appendix A).
bool facesAway(vec4 p[3], float aspect) { return overLens(polarForm(p, p, p), aspect) < -roundingOf(p); }

// Returns true if the triangle's back is visible from the entire lens while its corners and their circles of confusion
// move linearly from `p` to `q` (Munkberg et al. 2012, Equations 7 and 8): all Bernstein coefficients of the facing
// test as a polynomial in time are negative.
bool facesAway(vec4 p[3], vec4 q[3], float aspect) {
    vec3 second = (polarForm(q, p, p) + polarForm(p, q, p) + polarForm(p, p, q)) / 3.0;
    vec3 third = (polarForm(p, q, q) + polarForm(q, p, q) + polarForm(q, q, p)) / 3.0;
    float largest = max(max(overLens(polarForm(p, p, p), aspect), overLens(second, aspect)),
                        max(overLens(third, aspect), overLens(polarForm(q, q, q), aspect)));
    vec4 bound[3];
    for (int i = 0; i < 3; ++i) bound[i] = max(abs(p[i]), abs(q[i]));
    return largest < -roundingOf(bound);
}

void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= triangleCount) return;
    uvec4 triangle = triangles[index];
    float aspect = float(imageSize.x) / float(imageSize.y);
    vec4 corners[3] = vec4[3](clips[triangle.x], clips[triangle.y], clips[triangle.z]);
    // Culling assumes that the lens shear is linear in the lens point, which isn't true with aberrations.
    bool mayCull = draws[triangle.w].doubleSided == 0u && !aberrations;
    Area area = Area(vec2(1e30), vec2(-1e30));
    add(area, corners, aspect);
    if (moving) {
        // While a vertex moves in front of the camera, its image position and the diameter of its circle of confusion
        // stay between their values at the start and the end. No such bound exists if a corner crosses the near plane.
        vec4 later[3] = vec4[3](clipAtEnd(triangle.x), clipAtEnd(triangle.y), clipAtEnd(triangle.z));
        float near = frame.projection.z;
        float minimum = min(min(min(corners[0].z, corners[1].z), corners[2].z), min(min(later[0].z, later[1].z), later[2].z));
        float maximum = max(max(max(corners[0].z, corners[1].z), corners[2].z), max(max(later[0].z, later[1].z), later[2].z));
        if (maximum < near) return;
        if (mayCull && facesAway(corners, later, aspect)) return;
        add(area, later, aspect);
        if (minimum < near) area = Area(vec2(-1.0), vec2(1.0));
    } else {
        if (area.minimum.x > area.maximum.x) return;
        if (mayCull && facesAway(corners, aspect)) return;
        if (aberrations && min(min(corners[0].z, corners[1].z), corners[2].z) < frame.projection.z) area = Area(vec2(-1.0), vec2(1.0));
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
