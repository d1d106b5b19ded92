// Chooses tessellation levels for which the circle of confusion C is linear in each part of a triangle, within the
// tolerance cocLimits.w. The level of an edge depends only on the edge, so neighbouring triangles agree. An edge has at
// most object.levels.y parts; triangles that need more keep an error above the tolerance.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/coc_pieces.glsl"
#include "include/surface_corners.glsl"

layout(vertices = 3) out;

in Unsheared {
#include "include/unsheared_varyings.glsl"
} unsheared[];

out SurfaceVaryings {
#include "include/surface_varyings.glsl"
} passedOn[];
out Unsheared {
#include "include/unsheared_varyings.glsl"
} unshearedOut[];

#define SURFACE_OUT passedOn[gl_InvocationID]
#include "include/surface_write.glsl"

// Returns the two smooth functions that the circle of confusion C follows in front of the focus plane and behind it.
vec2 smoothPieces(vec3 pinhole, vec2 own) {
    CocPieces pieces = cocPieces(pinhole, own);
    return pieces.factor * vec2(pieces.front, pieces.behind) + pieces.added;
}

// Returns the image offsets that aberrations cause for two rays through the lens rim, times w, in units of half the
// image's width. xy: ray through lens point (u, v) = (1, 0); zw: ray through (0, 1).
vec4 aberrationPieces(vec3 pinhole) {
    float w = max(pinhole.z, frame.projection.z);
    vec2 perAspect = vec2(1.0, sqrt(frame.cocLimits.z));
    vec2 ndc = pinhole.xy / w;
    return w * vec4(aberration(ndc, vec2(1.0, 0.0)) * perAspect, aberration(ndc, vec2(0.0, 1.0) / perAspect) * perAspect);
}

bool comesFirst(vec3 p, vec3 q) {
    if (p.x != q.x) return p.x < q.x;
    return p.y != q.y ? p.y < q.y : p.z < q.z;
}

// Returns the number of parts into which an edge must be divided. Dividing an edge into n parts reduces the deviation
// of a smooth function from its linear interpolation by a factor of n².
float partsOf(int first, int second) {
    if (comesFirst(unsheared[second].pinhole, unsheared[first].pinhole)) {
        int swapped = first;
        first = second;
        second = swapped;
    }
    vec3 p = unsheared[first].pinhole;
    vec3 q = unsheared[second].pinhole;
    vec2 ownP = unsheared[first].ownBlur;
    vec2 ownQ = unsheared[second].ownBlur;
    // Measure only the visible part of the edge, beyond the near plane.
    float near = frame.projection.z;
    if (p.z <= near && q.z <= near) return 1.0;
    float begin = p.z < near ? (near - p.z) / (q.z - p.z) : 0.0;
    float end = q.z < near ? (near - p.z) / (q.z - p.z) : 1.0;
    vec2 atBegin = smoothPieces(mix(p, q, begin), mix(ownP, ownQ, begin));
    vec2 atEnd = smoothPieces(mix(p, q, end), mix(ownP, ownQ, end));
    vec4 missedAtBegin = aberrationPieces(mix(p, q, begin));
    vec4 missedAtEnd = aberrationPieces(mix(p, q, end));
    float deviation = 0.0;   // px
    for (int i = 1; i < 8; ++i) {
        float part = float(i) / 8.0;
        float at = mix(begin, end, part);
        vec3 middle = mix(p, q, at);
        vec2 away = abs(smoothPieces(middle, mix(ownP, ownQ, at)) - mix(atBegin, atEnd, part));
        if (aberrations) {
            vec4 missed = abs(aberrationPieces(middle) - mix(missedAtBegin, missedAtEnd, part));
            away = max(away, max(missed.xy, missed.zw));
        }
        deviation = max(deviation, max(away.x, away.y) / max(middle.z, near) * frame.coc.z);
    }
    return clamp(ceil(sqrt(1.5 * deviation / frame.cocLimits.w) / (end - begin)), 1.0, object.levels.y);
}

void main() {
    writeSurface(surfaceAt(gl_InvocationID));
    unshearedOut[gl_InvocationID].pinhole = unsheared[gl_InvocationID].pinhole;
    unshearedOut[gl_InvocationID].ownBlur = unsheared[gl_InvocationID].ownBlur;
    unshearedOut[gl_InvocationID].lensAndJitter = unsheared[gl_InvocationID].lensAndJitter;
    unshearedOut[gl_InvocationID].bandShift = unsheared[gl_InvocationID].bandShift;
    if (gl_InvocationID == 0) {
        vec3 parts = vec3(partsOf(1, 2), partsOf(2, 0), partsOf(0, 1));
        gl_TessLevelOuter[0] = parts.x;
        gl_TessLevelOuter[1] = parts.y;
        gl_TessLevelOuter[2] = parts.z;
        gl_TessLevelInner[0] = max(parts.x, max(parts.y, parts.z));
    }
}
