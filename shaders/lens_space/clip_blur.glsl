// Computes the circle of confusion C of a vertex in clip space, the signed CoC times the depth w. Behind the camera, C
// is extrapolated with the formula of coc_pieces.glsl, but without the upper limit, the max blur behind the focus
// plane. Inside a triangle the lens-space methods interpolate C linearly (Munkberg, Toth and Akenine-Möller 2012).

#include "include/coc_pieces.glsl"

// `own`: the vertex's blur modifiers (include/lens.glsl).
float clipBlur(vec3 pinhole, vec2 own) {
    if (!cocControls) return frame.coc.x + frame.coc.y * pinhole.z;
    CocPieces pieces = cocPieces(pinhole, own);
    float c = pieces.factor * (min(0.0, pieces.front) + max(0.0, pieces.behind)) + pieces.added;
    c = max(c, -frame.cocLimits.x * pinhole.z);
    return pinhole.z > 0.0 ? min(c, frame.cocLimits.y * pinhole.z) : c;
}
