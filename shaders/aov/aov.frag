// Writes depth (m), signed CoC diameter (px) and fractional level of detail of the nearest surface seen through the
// pinhole.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/surface_fragment.glsl"
#include "include/material_textures.glsl"
#include "include/alpha_mask.glsl"

layout(location = 0) out float depthOut;
layout(location = 1) out float cocOut;
layout(location = 2) out float levelOut;

vec4 surfaceTexel(int unit, int slot) { return texture(materialTextures[unit], uvOf(slot, surface.uv)); }

void main() {
    readSurface();
    uvec2 pixel = uvec2(gl_FragCoord.xy + frame.window.xy);
#ifdef CHOOSES_BY_ALPHA
    if (maskHides(texturedColor(surface.color).a, surface.color.a, pixel, 0.0)) discard;
#endif
    float w = 1.0 / gl_FragCoord.w;
    depthOut = w;
    vec2 size = frame.coc.z * vec2(1.0, frame.projection.x / frame.projection.y);
    cocOut = circleOfConfusion(gl_FragCoord.z, ndcOfPixel(gl_FragCoord.xy, ivec2(size + 0.5)), surface.ownBlur);
    levelOut = object.values.x;
}
