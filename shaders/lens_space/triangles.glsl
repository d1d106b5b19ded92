// Triangles of a frame as seen from a point of the lens.
//
// A vertex is (x, y, w, C): its clip position and the clip-space circle of confusion C, the signed CoC times the depth
// w. Let (u, v) be a point of the unit disk that stands for the lens, and k the image's aspect ratio. Seen from the
// lens point l = (u, k·v), the clip position is (x, y) + C·l (Munkberg, Toth and Akenine-Möller 2012). Relative to an
// image position s this is q = (x, y) + C·l − w·s. The edge from vertex i to vertex j has the function
//   e_ij = q_i × q_j,
// the volume spanned by the ray and the edge. All three functions are ≥ 0 if the ray meets the triangle's front at w >
// 0, and ≤ 0 if it meets the back. This also holds for vertices behind the camera (Olano and Greer 1997, Triangle Scan
// Conversion Using 2D Homogeneous Coordinates). Divided by their sum, the three functions are the barycentric
// coordinates of the hit.
//
// With `precise`, neighbouring triangles compute the same value with opposite sign for a shared edge, so no ray passes
// between them.

struct Draw {
    uint firstRay;      // only rays [firstRay, endRay) of each pixel can hit the draw's triangles
    uint endRay;
    uint group;         // group of surfaces with the same shader
    uint doubleSided;
    uint seeThrough;    // 1: surfaces are cut out or blended, so rays may pass through them
};

const uint noTriangle = 0xffffffffu;

layout(std430, binding = 0) readonly buffer ClipBlock { vec4 clips[]; };
#ifdef MOVING
// Clip positions of the vertices at the end of the current part of the exposure.
layout(std430, binding = 1) readonly buffer ClipEndBlock { vec4 clipsAtEnd[]; };
vec4 clipAtEnd(uint vertex) { return clipsAtEnd[vertex]; }
#else
vec4 clipAtEnd(uint vertex) { return clips[vertex]; }
#endif
// xyz: vertex indices; w: index of the Draw
layout(std430, binding = 2) readonly buffer TriangleBlock { uvec4 triangles[]; };

// Returns a vertex as (x, y, w, C), its clip position and clip-space circle of confusion, at the time `fraction` in the
// current part of the exposure. All four values are linear in time.
vec4 clipAt(uint vertex, float fraction) {
    return moving ? mix(clips[vertex], clipAtEnd(vertex), fraction) : clips[vertex];
}

// Returns q, the vertex relative to the image position `place` as seen from lens point `lens`. The circle of confusion
// of a thin lens is linear in the depth w: C = a + b·w. So the compiler can compute the lens offset with one
// multiplication and one addition per coordinate.
vec2 relativeTo(vec4 clip, vec2 lens, vec2 place) {
    precise vec2 q;
    if (cocControls)
        q = clip.xy + clip.w * lens - clip.z * place;
    else
        q = clip.xy + frame.coc.x * lens + clip.z * (frame.coc.y * lens - place);
    // The image offset that astigmatism and coma cause is not proportional to the lens point, so C does not include it.
    if (aberrations) {
        float w = max(clip.z, frame.projection.z);
        q += w * aberration(clip.xy / w, lens);
    }
    return q;
}

// Returns the max image offset that aberrations cause over all lens points, in normalised device coordinates, for a
// vertex at image position `ndc`.
vec2 aberrationReach(vec2 ndc) {
    vec2 perAspect = vec2(1.0, sqrt(frame.cocLimits.z));
    float radius = length(ndc * perAspect);
    return vec2(abs(frame.cocOther.z) * radius * radius + 3.0 * abs(frame.cocOther.w) * radius) / perAspect;
}

// Returns the edge functions of a triangle; component i belongs to the edge opposite to corner i.
vec3 edgeFunctions(vec4 a, vec4 b, vec4 c, vec2 lens, vec2 place) {
    precise vec2 qa = relativeTo(a, lens, place);
    precise vec2 qb = relativeTo(b, lens, place);
    precise vec2 qc = relativeTo(c, lens, place);
    precise vec3 e = vec3(qb.x * qc.y - qb.y * qc.x, qc.x * qa.y - qc.y * qa.x, qa.x * qb.y - qa.y * qb.x);
    return e;
}

// Returns the min depth w of a triangle's corners over time.
float minDepthOf(uvec3 vertices) {
    float minimum = min(min(clips[vertices.x].z, clips[vertices.y].z), clips[vertices.z].z);
    if (moving) minimum = min(minimum, min(min(clipAtEnd(vertices.x).z, clipAtEnd(vertices.y).z), clipAtEnd(vertices.z).z));
    return minimum;
}

// Returns the depth w at which a ray meets the plane of a triangle. `edges`: the triangle's edge functions.
float depthOnPlane(vec3 edges, vec4 a, vec4 b, vec4 c) { return dot(edges / (edges.x + edges.y + edges.z), vec3(a.z, b.z, c.z)); }

// Returns the depth w at which a ray hits the triangle; 0 for a miss or a hit in front of the near plane.
float depthMet(vec4 a, vec4 b, vec4 c, bool doubleSided, vec2 lens, vec2 place) {
    vec3 e = edgeFunctions(a, b, c, lens, place);
    bool met = all(greaterThanEqual(e, vec3(0.0))) || (doubleSided && all(lessThanEqual(e, vec3(0.0))));
    float sum = e.x + e.y + e.z;
    if (!met || sum == 0.0) return 0.0;
    float w = depthOnPlane(e, a, b, c);
    return w >= frame.projection.z ? w : 0.0;
}
