// The triangles of a frame and what a point of the lens sees of them.
//
// A vertex is (x, y, w, C): seen from the lens point l = (u, k·v) it lies at p + C·(l, 0) (Munkberg, Toth and Akenine-Möller 2012).
// Relative to a place s of the image it is q = (x, y) + C·l − w·s, and the edge from i to j has the function
//   e_ij = q_i × q_j,
// which is the volume of the ray and the edge: all three are ≥ 0 where the ray meets the triangle's front at w > 0, all ≤ 0 where it
// meets its back, for vertices on either side of the camera (Olano and Greer 1997, Triangle Scan Conversion Using 2D Homogeneous
// Coordinates). They are the barycentric coordinates of the place that is met, up to their sum. `precise`: neighbours find the same
// value for the edge that they share, with the opposite sign, and no ray passes between them.

struct Draw {
    uint firstRay;      // of a pixel: rays [firstRay, endRay) see it
    uint endRay;
    uint group;         // of surfaces that are shaded alike
    uint doubleSided;
};

const uint noTriangle = 0xffffffffu;

layout(std430, binding = 0) readonly buffer ClipBlock { vec4 clips[]; };
#ifdef MOVING
layout(std430, binding = 1) readonly buffer ClipEndBlock { vec4 clipsAtEnd[]; };   // of the part of the exposure at hand
#endif
layout(std430, binding = 2) readonly buffer TriangleBlock { uvec4 triangles[]; };  // three vertices; draw

// A vertex `fraction` of the way through the part of the exposure: positions and C are linear in time.
vec4 clipAt(uint vertex, float fraction) {
#ifdef MOVING
    return mix(clips[vertex], clipsAtEnd[vertex], fraction);
#else
    return clips[vertex];
#endif
}

// q: with a plain lens, C = a + b·w, the lens costs a multiplication and an addition.
vec2 relativeTo(vec4 clip, vec2 lens, vec2 place) {
#ifdef COC_CONTROLS
    precise vec2 q = clip.xy + clip.w * lens - clip.z * place;
#else
    precise vec2 q = clip.xy + frame.coc.x * lens + clip.z * (frame.coc.y * lens - place);
#endif
    return q;
}

// The functions of the edges opposite to the three corners.
vec3 edgeFunctions(vec4 a, vec4 b, vec4 c, vec2 lens, vec2 place) {
    precise vec2 qa = relativeTo(a, lens, place);
    precise vec2 qb = relativeTo(b, lens, place);
    precise vec2 qc = relativeTo(c, lens, place);
    precise vec3 e = vec3(qb.x * qc.y - qb.y * qc.x, qc.x * qa.y - qc.y * qa.x, qa.x * qb.y - qa.y * qb.x);
    return e;
}

// The depth w where the ray meets the triangle; 0 where it doesn't, or in front of the near plane.
float depthMet(vec4 a, vec4 b, vec4 c, bool doubleSided, vec2 lens, vec2 place) {
    vec3 e = edgeFunctions(a, b, c, lens, place);
    bool met = all(greaterThanEqual(e, vec3(0.0))) || (doubleSided && all(lessThanEqual(e, vec3(0.0))));
    float sum = e.x + e.y + e.z;
    if (!met || sum == 0.0) return 0.0;
    float w = dot(e / sum, vec3(a.z, b.z, c.z));
    return w >= frame.projection.z ? w : 0.0;
}
