// Computes the smooth terms of the clip-space circle of confusion C; src/lens/circle_of_confusion.h defines F, B, R₁
// and R₂. Unlike C itself, the terms are also defined behind the near plane. They are linear if C has no curved terms
// and the surface's blur modifiers are uniform.
//   C = clamp(factor·(min(0, front) + max(0, behind)) + added, −R₁·w, R₂·w)

struct CocPieces {
    float factor;   // blur factor of the surface times (1 + g·r²), as in circle_of_confusion.h
    float front;    // w·F of circle_of_confusion.h; negative in front of the focus plane
    float behind;   // w·B of circle_of_confusion.h; positive behind the focus plane
    float added;
};

CocPieces cocPieces(vec3 pinhole, vec2 own) {
    vec2 q = pinhole.xy * vec2(1.0, sqrt(frame.cocLimits.z));
    float square = dot(q, q);
    float w = max(pinhole.z, frame.projection.z);
    float focus = pinhole.z + dot(frame.cocField.xy, pinhole.xy) + frame.cocField.z * square / w;
    return CocPieces(own.x * (1.0 + frame.cocField.w * square / (w * w)), frame.coc.x + (frame.coc.y + bandShift) * focus,
                     frame.cocOther.x + (frame.coc.w + bandShift) * focus, own.y * pinhole.z);
}
