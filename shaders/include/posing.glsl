// Poses vertices: applies morph targets, then joint matrices, like src/scene/posed_mesh.h on the CPU. skinInfluences:
// number of joints per vertex, 4 or 8; 0 without a skin. morphed: whether morph targets change positions; morphNormals
// and morphTangents: whether they also change normals and tangents. morphAttributes: number of these attributes, 1 … 3.
//
// A pose in the buffer `poses` begins with the three rows of the view-from-vertex matrix of each joint; without a skin,
// the object is the only joint. The weight and the index of each active morph target follow. With cameraMoves, the pose
// ends with a matrix from the view space at this shutter time to the view space in the middle of the exposure, in which
// lights and sky are defined.

layout(location = 9) in vec4 jointsIn;
layout(location = 10) in vec4 weightsIn;
layout(location = 11) in vec4 joints1In;
layout(location = 12) in vec4 weights1In;

layout(binding = 6) uniform samplerBuffer poses;
// per target: displacements of positions, then normals, then tangents
layout(binding = 7) uniform samplerBuffer morphDisplacements;

struct Rows {         // three rows of an affine matrix
    vec4 x;
    vec4 y;
    vec4 z;
};

Rows rowsAt(int texel) {
    return Rows(texelFetch(poses, texel), texelFetch(poses, texel + 1), texelFetch(poses, texel + 2));
}

void addJoints(inout Rows sum, inout float weightSum, int firstTexel, vec4 joints, vec4 weights) {
    for (int i = 0; i < 4; ++i) {
        if (!(weights[i] > 0.0)) continue;
        int joint = joints[i] < float(object.posing.y) ? int(joints[i]) : 0;   // indices out of range select joint 0
        Rows rows = rowsAt(firstTexel + 3 * joint);
        sum.x += weights[i] * rows.x;
        sum.y += weights[i] * rows.y;
        sum.z += weights[i] * rows.z;
        weightSum += weights[i];
    }
}

Rows vertexRows(int firstTexel) {
    if (skinInfluences == 0) return rowsAt(firstTexel);
    Rows sum = Rows(vec4(0.0), vec4(0.0), vec4(0.0));
    float weightSum = 0.0;
    addJoints(sum, weightSum, firstTexel, jointsIn, weightsIn);
    if (skinInfluences == 8) addJoints(sum, weightSum, firstTexel, joints1In, weights1In);
    if (weightSum == 0.0) return rowsAt(firstTexel);
    return Rows(sum.x / weightSum, sum.y / weightSum, sum.z / weightSum);
}

vec3 turned(Rows rows, vec3 direction) {
    return vec3(dot(rows.x.xyz, direction), dot(rows.y.xyz, direction), dot(rows.z.xyz, direction));
}

// Transforms a normal by the inverse transpose of a matrix with rows `rows`, and keeps the normal's length. The rows of
// the inverse transpose are cross products of `rows`, divided by the determinant.
vec3 turnedNormal(Rows rows, vec3 normal) {
    vec3 x = cross(rows.y.xyz, rows.z.xyz);
    vec3 y = cross(rows.z.xyz, rows.x.xyz);
    vec3 z = cross(rows.x.xyz, rows.y.xyz);
    vec3 result = vec3(dot(x, normal), dot(y, normal), dot(z, normal)) * sign(dot(rows.x.xyz, x));
    float size = length(result);
    return size > 0.0 ? result * (length(normal) / size) : normal;
}

Posed morphedVertex(int firstTexel, Posed vertex) {
    int target = firstTexel + 3 * object.posing.y;
    for (int i = 0; i < object.posing.z; ++i) {
        vec4 morph = texelFetch(poses, target + i);
        int texel = int(morph.y) * morphAttributes * object.posing.w + gl_VertexID;
        vertex.position += morph.x * texelFetch(morphDisplacements, texel).xyz;
        if (morphNormals) {
            texel += object.posing.w;
            vertex.normal += morph.x * texelFetch(morphDisplacements, texel).xyz;
        }
        if (morphTangents) {
            texel += object.posing.w;
            vertex.tangent += morph.x * texelFetch(morphDisplacements, texel).xyz;
        }
    }
    return vertex;
}

// Transforms `vertex` from the rest pose to the pose with index `pose`.
Posed posedVertex(int pose, Posed vertex) {
    int firstTexel = pose * object.posing.x;
    if (morphed) vertex = morphedVertex(firstTexel, vertex);
    Rows rows = vertexRows(firstTexel);
    vertex.position = turned(rows, vertex.position) + vec3(rows.x.w, rows.y.w, rows.z.w);
    vertex.normal = turnedNormal(rows, vertex.normal);
    vertex.tangent = turned(rows, vertex.tangent);
    return vertex;
}

Posed between(Posed a, Posed b, float fraction) {
    return Posed(mix(a.position, b.position, fraction), mix(a.normal, b.normal, fraction), mix(a.tangent, b.tangent, fraction));
}

// Transforms a vertex and the lens point `eye` from the view space at the time `moment` (see vertexAt) to the view
// space in the middle of the exposure.
void toMiddle(vec2 moment, inout Posed vertex, inout vec3 eye) {
    int texel = (int(moment.x) + 1) * object.posing.x - 3;
    Rows rows = rowsAt(texel);
    if (moment.y > 0.0) {
        Rows next = rowsAt(texel + object.posing.x);
        rows = Rows(mix(rows.x, next.x, moment.y), mix(rows.y, next.y, moment.y), mix(rows.z, next.z, moment.y));
    }
    vec3 middle = vec3(rows.x.w, rows.y.w, rows.z.w);
    vertex = Posed(turned(rows, vertex.position) + middle, turned(rows, vertex.normal), turned(rows, vertex.tangent));
    eye = turned(rows, eye) + middle;
}

// Returns the vertex at the time `moment`: x is the index of a shutter time, y is the fraction of the way to the next
// shutter time. Between two shutter times, the clip position is linear in time (Munkberg et al. 2012). The caller
// evaluates the clip-space circle of confusion C at the interpolated position. For a thin lens, C is then linear in
// time as in that paper; with blur controls, C is the same as in a still frame with the vertex at that position.
Vertex vertexAt(vec2 moment, Posed rest, vec3 eye) {
    Posed posed = posedVertex(moving ? int(moment.x) : 0, rest);
    if (moving && moment.y > 0.0) posed = between(posed, posedVertex(int(moment.x) + 1, rest), moment.y);
    Vertex vertex = Vertex(posed, eye, pinholePosition(posed.position));
    if (cameraMoves) toMiddle(moment, vertex.view, vertex.eye);
    return vertex;
}
