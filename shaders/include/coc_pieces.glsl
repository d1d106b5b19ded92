// The smooth pieces that C is made of, in clip space and also behind the near plane, where C itself has no meaning: without
// curved forms they are linear, as long as the surface's own factor and what it adds are the same everywhere.
// C = clamp(factor·(min(0, front) + max(0, behind)) + added, −R₁·w, R₂·w).

struct CocPieces {
    float factor;   // own factor·(1 + g·r²)
    float front;    // w·F
    float behind;   // w·B
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
