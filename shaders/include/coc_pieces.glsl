// Computes the smooth terms factor, front, behind and added of the clip-space circle of confusion (CoC) C, which is the
// signed CoC times the depth w:
//   C = clamp(factor·(min(0, front) + max(0, behind)) + added, −R₁·w, R₂·w)
// R₁ and R₂ are the max blur in front of and behind the focus plane, as fractions of the image's width
// (src/lens/circle_of_confusion.h). Unlike C itself, the terms have no kinks, and they are also defined behind the near
// plane. They are linear across a triangle if the focus surface is not curved, the blur does not vary with the distance
// from the image's centre, and the surface's blur modifiers are uniform.

struct CocPieces {
    // Blur factor of the surface times the radial gain 1 + g·r², with the distance r from the image's centre and the
    // coefficient g in frame.cocField.
    float factor;
    float front;    // w times the lens's signed CoC for points in front of the focus plane (< 0 there)
    float behind;   // w times the lens's signed CoC for points behind the focus plane (> 0 there)
    float added;    // w times the blur that the surface's modifiers add, as a fraction of the image's width
};

CocPieces cocPieces(vec3 pinhole, vec2 own) {
    vec2 q = pinhole.xy * vec2(1.0, sqrt(frame.cocLimits.z));
    float square = dot(q, q);
    float w = max(pinhole.z, frame.projection.z);
    float focus = pinhole.z + dot(frame.cocField.xy, pinhole.xy) + frame.cocField.z * square / w;
    return CocPieces(own.x * (1.0 + frame.cocField.w * square / (w * w)), frame.coc.x + (frame.coc.y + bandShift) * focus,
                     frame.cocOther.x + (frame.coc.w + bandShift) * focus, own.y * pinhole.z);
}
