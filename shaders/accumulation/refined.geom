// Cuts a triangle at the near plane and along the kinks of the circle of confusion C (abrupt changes of its slope),
// then shears the pieces. Inside each piece C is linear (Munkberg, Toth and Akenine-Möller 2012, Figures 2 and 10), and
// |C/w| (w: depth) never exceeds its values at the piece's vertices. From front to back, the kinks lie where
//   F·factor + added = −R₁   (the blur in front of the focus plane reaches its limit R₁)
//   F = 0                    (the range of sharp depths begins)
//   B = 0                    (the range of sharp depths ends)
//   B·factor + added = R₂    (the blur behind the focus plane reaches its limit R₂)
// F and B are the blur in front of and behind the focus plane as functions of 1/w; `factor` and `added` are the
// surface's blur factor and added blur (src/lens/circle_of_confusion.h).
//
// Each cut position on a triangle's edge depends only on the edge's two ends, and not on their order. Neighbouring
// triangles therefore cut their shared edge at the same position, and no gap opens.

layout(triangles) in;
layout(triangle_strip, max_vertices = 30) out;   // 5 pieces with at most 6 vertices each

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/coc_pieces.glsl"
#include "include/surface_corners.glsl"
#include "include/surface_output.glsl"

in Unsheared {
#include "include/unsheared_varyings.glsl"
} unsheared[];

// A convex piece of a triangle, given by the barycentric coordinates of its vertices.
struct Piece {
    int count;
    vec3 vertices[6];
};

// Returns the point between p and q where the linear function with `values` at the triangle's corners is 0.
vec3 cut(vec3 p, vec3 q, vec3 values) {
    for (int k = 0; k < 3; ++k) {
        if (p[k] != 0.0 || q[k] != 0.0) continue;   // p and q don't both lie on the edge opposite to corner k
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        precise float atI = values[j] / (values[j] - values[i]);
        precise float atJ = values[i] / (values[i] - values[j]);
        vec3 weights = vec3(0.0);
        weights[i] = atI;
        weights[j] = atJ;
        return weights;
    }
    float atP = dot(p, values);
    float atQ = dot(q, values);
    return (atQ * p - atP * q) / (atQ - atP);
}

// Returns the part of `piece` in which the linear function with `values` at the triangle's corners is ≥ 0 (Sutherland
// and Hodgman 1974).
Piece kept(Piece piece, vec3 values) {
    Piece result;
    result.count = 0;
    for (int i = 0; i < piece.count; ++i) {
        vec3 p = piece.vertices[i];
        vec3 q = piece.vertices[i + 1 < piece.count ? i + 1 : 0];
        bool pInside = dot(p, values) >= 0.0;
        bool qInside = dot(q, values) >= 0.0;
        if (pInside && result.count < 6) result.vertices[result.count++] = p;
        if (pInside != qInside && result.count < 6) result.vertices[result.count++] = cut(p, q, values);
    }
    return result;
}

void emit(vec3 weights) {
    precise vec3 pinhole = weights.x * unsheared[0].pinhole + weights.y * unsheared[1].pinhole + weights.z * unsheared[2].pinhole;
    precise vec2 own = weights.x * unsheared[0].ownBlur + weights.y * unsheared[1].ownBlur + weights.z * unsheared[2].ownBlur;
    writeSurface(weightedSurface(weights));
    gl_Position = throughLens(pinhole, own, unsheared[0].lensAndJitter);
    gl_Layer = int(corners[0].layer);
    EmitVertex();
}

// Emits a piece of n vertices as a triangle strip in the order 0, 1, n − 1, 2, n − 2, …
void emit(Piece piece) {
    if (piece.count < 3) return;
    emit(piece.vertices[0]);
    for (int low = 1, high = piece.count - 1; low <= high; ++low, --high) {
        emit(piece.vertices[low]);
        if (low != high) emit(piece.vertices[high]);
    }
    EndPrimitive();
}

void main() {
    if (chromatic) bandShift = unsheared[0].bandShift;
    // Values of five linear functions at the triangle's corners. The first four are 0 at the kinks of the circle of
    // confusion as a function of depth, from front to back. The last is 0 on the near plane.
    vec3 atLimitInFront, front, behind, atLimitBehind, beyondNear;
    for (int i = 0; i < 3; ++i) {
        vec3 pinhole = unsheared[i].pinhole;
        CocPieces pieces = cocPieces(pinhole, unsheared[i].ownBlur);
        atLimitInFront[i] = pieces.factor * pieces.front + pieces.added + frame.cocLimits.x * pinhole.z;
        front[i] = pieces.front;
        behind[i] = pieces.behind;
        atLimitBehind[i] = pieces.factor * pieces.behind + pieces.added - frame.cocLimits.y * pinhole.z;
        beyondNear[i] = pinhole.z - frame.projection.z;
    }
    Piece whole = Piece(3, vec3[6](vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(0), vec3(0), vec3(0)));
    if (any(lessThan(beyondNear, vec3(0.0)))) whole = kept(whole, beyondNear);
    if (whole.count < 3) return;

    // True if a range of depths is sharp. Otherwise, one function of depth gives the blur on both sides of the focus
    // plane. The circle of confusion then has kinks only where the max blur limits it.
    bool range = frame.coc.x != frame.cocOther.x || frame.coc.y != frame.coc.w;
    if (any(lessThan(atLimitInFront, vec3(0.0)))) emit(kept(whole, -atLimitInFront));
    Piece middle = any(lessThan(atLimitInFront, vec3(0.0))) ? kept(whole, atLimitInFront) : whole;
    if (any(greaterThan(atLimitBehind, vec3(0.0)))) {
        emit(kept(middle, atLimitBehind));
        middle = kept(middle, -atLimitBehind);
    }
    if (!range) {
        emit(middle);
        return;
    }
    emit(kept(middle, -front));
    emit(kept(middle, behind));
    emit(kept(kept(middle, front), -behind));
}
